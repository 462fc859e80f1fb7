// SPDX-License-Identifier: BSD-3-Clause
//
// What the panel is made of: rows that show a value and tell when it was changed. Each has an element and
// show(value).

let last = 0;
const newId = () => `c${++last}`;

export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) {
      element[name] = value;
    } else {
      element.setAttribute(name, value);
    }
  }
  element.append(...children);
  return element;
}

export function section(title, ...children) {
  return make("fieldset", {}, make("legend", { textContent: title }), ...children);
}

export function row(label, id, title, ...children) {
  const name = id
    ? make("label", { htmlFor: id, textContent: label, title })
    : make("span", { className: "label", textContent: label, title });
  return make("div", { className: "row" }, name, ...children);
}

const wide = (...children) => make("div", { className: "wide together" }, ...children);

/** What a row's title says: what it means, its unit, its default. */
export function titleOf({ help, unit, default: usual, kind }, unitName) {
  const told = unit ? ` Unit: ${unitName ?? unit}.` : "";
  const number = kind === "number" && usual[0] !== null ? ` Default: ${usual[0]}.` : "";
  return `${help}.${told}${number}`;
}

/**
 * A slider and a number beside it. The slider may be finer near its beginning (power); the number takes what is
 * beyond the slider's ends.
 */
export function slider({ label, title, range: [from, to, power], low, high, whole = false, onInput, onEnd }) {
  const id = newId();
  const steps = 1000;
  const toShare = (value) => Math.min(Math.max((value - from) / (to - from), 0), 1) ** (1 / power);
  const digits = (value) => (whole ? Math.round(value) : Number(value.toPrecision(4)));
  const track = make("input", { type: "range", id, min: 0, max: steps, step: 1, title });
  const number = make("input", { type: "number", step: "any", title, "aria-label": `${label}, number` });
  const text = (value) =>
    value !== 0 && Math.abs(value) < 1e-3
      ? Number(value.toPrecision(3)).toExponential()
      : String(digits(value));
  const limits = (value) => Math.min(Math.max(value, low ?? -Infinity), high ?? Infinity);
  let shown = NaN;
  track.addEventListener("input", () => {
    const value = limits(digits(from + (to - from) * (Number(track.value) / steps) ** power));
    track.setAttribute("aria-valuetext", String(value));
    onInput(value);
  });
  track.addEventListener("change", () => onEnd());
  number.addEventListener("change", () => {
    const value = number.valueAsNumber;
    if (Number.isFinite(value)) {
      onInput(limits(whole ? Math.round(value) : value));
    } else {
      number.value = text(shown);
    }
    onEnd();
  });
  return {
    element: row(label, id, title, track, number),
    track,
    number,
    setRange(newFrom, newTo) {
      [from, to] = [newFrom, newTo];
      shown = NaN;
    },
    show(value) {
      if (Object.is(value, shown)) {
        return;
      }
      shown = value;
      // Not while it is held: rounding would move it under the finger.
      if (!(document.activeElement === track && track.matches(":active"))) {
        track.value = Math.round(steps * toShare(value));
      }
      track.setAttribute("aria-valuetext", String(digits(value)));
      number.value = text(value);
    },
    enable(on) {
      track.disabled = number.disabled = !on;
    },
  };
}

export function check({ label, title, onChange }) {
  const box = make("input", { type: "checkbox", title });
  const element = make("div", { className: "row" }, wide(make("label", { title }, box, label)));
  element.firstChild.style.gridColumn = "1 / 4";
  box.addEventListener("change", () => onChange(box.checked));
  return { element, box, show: (value) => (box.checked = value) };
}

export function select({ label, title, options, onChange }) {
  const id = newId();
  const list = make("select", { id, title });
  const fill = (entries) =>
    list.replaceChildren(...entries.map(([value, text]) => make("option", { value, textContent: text })));
  fill(options);
  list.addEventListener("change", () => onChange(list.value));
  const element = row(label, id, title, list);
  list.classList.add("wide");
  return { element, list, fill, show: (value) => (list.value = value) };
}

/** A line of text, told when it was changed. */
export function text({ label, title, onChange }) {
  const id = newId();
  const input = make("input", { type: "text", id, title });
  input.addEventListener("change", () => onChange(input.value));
  input.classList.add("wide");
  return { element: row(label, id, title, input), input, show: (value) => (input.value = value) };
}

export function radios({ label, options, onChange }) {
  const name = newId();
  const group = wide();
  group.setAttribute("role", "radiogroup");
  group.setAttribute("aria-label", label);
  const inputs = options.map(([value, text, title]) => {
    const input = make("input", { type: "radio", name, value });
    input.addEventListener("change", () => onChange(value));
    group.append(make("label", { title: title ?? "" }, input, text));
    return input;
  });
  return {
    element: row(label, null, "", group),
    show: (value) => inputs.forEach((input) => (input.checked = input.value === value)),
    inputs,
  };
}

export function color({ label, title, onInput, onEnd }, ...more) {
  const id = newId();
  const input = make("input", { type: "color", id, title });
  input.addEventListener("input", () => onInput(input.value));
  input.addEventListener("change", () => onEnd());
  const element = row(label, id, title, input, ...more);
  if (more.length === 0) {
    input.classList.add("wide");
  }
  return {
    element,
    input,
    show: (hex) => {
      if (input.value !== hex) {
        input.value = hex;
      }
    },
  };
}

/** A picture that may be opened: a button, its name, and a button that takes it away. */
export function pictureRow({ label, title, role, onOpen, onRemove }) {
  const open = make("button", {
    type: "button",
    textContent: "Open…",
    title,
    "aria-label": `${label}: open`,
  });
  const remove = make("button", { type: "button", textContent: "×", "aria-label": `${label}: remove` });
  const name = make("span", { className: "name" });
  open.addEventListener("click", onOpen);
  remove.addEventListener("click", onRemove);
  const element = row(label, null, title, wide(open, name, remove));
  element.dataset.drop = role;
  return {
    element,
    show(text) {
      name.textContent = text ?? "none";
      name.title = text ?? "";
      remove.hidden = text === null;
    },
  };
}

export function button(text, title, onClick) {
  const element = make("button", { type: "button", textContent: text, title });
  element.addEventListener("click", onClick);
  return element;
}

export { wide };
