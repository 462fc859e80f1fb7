// SPDX-License-Identifier: BSD-3-Clause
//
// Single values as users write them, checked. A value that is out of range is a RangeError, one of another
// type or a word that nobody knows a TypeError.

//--------------------------------------------------------------------------------------------------
// Messages.

/** A value as part of a message. */
export function shown(value) {
  if (ArrayBuffer.isView(value)) {
    return `${value.constructor.name} of ${value.length}`;
  }
  if (typeof value === "bigint" || typeof value === "function" || typeof value === "symbol") {
    return typeof value;
  }
  let text;
  try {
    text = JSON.stringify(value, (key, inner) =>
      typeof inner === "number" && !Number.isFinite(inner) ? String(inner) : inner,
    );
  } catch {
    text = undefined;
  }
  text = typeof value === "number" ? String(value) : (text ?? String(value));
  return text.length > 60 ? `${text.slice(0, 60)} ...` : text;
}

const given = (name, value, expected) => `${name}: ${shown(value)} was given, ${expected} expected`;
export const typeError = (name, value, expected) => new TypeError(given(name, value, expected));
export const rangeError = (name, value, expected) => new RangeError(given(name, value, expected));

const listed = (words) =>
  words.map((word, k) => (k === 0 ? "" : k + 1 < words.length ? ", " : " or ") + `"${word}"`).join("");

// How many letters are to be changed to make one word of another.
function distance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, k) => k);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j) {
      next.push(Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1)));
    }
    row = next;
  }
  return row[b.length];
}

function suggestion(word, known) {
  const lower = word.toLowerCase();
  const scored = known
    .map((name) => ({ name, score: distance(lower, name.toLowerCase()) }))
    .sort((a, b) => a.score - b.score);
  const best = scored[0];
  return best && best.score <= Math.max(2, word.length / 3) ? `; did you mean ${best.name}?` : "";
}

export function refuseUnknown(path, object, known) {
  for (const key of Object.keys(object)) {
    if (!known.includes(key)) {
      throw new TypeError(`${path}${key}: there is no such option${suggestion(key, known)}`);
    }
  }
}

//--------------------------------------------------------------------------------------------------
// Single values.

const plainWord = (word) => word.toLowerCase().replace(/[-_ ]/g, "");
export const sameWord = (a, b) => plainWord(a) === plainWord(b);

export function needObject(name, value, expected = "an object is") {
  if (typeof value !== "object" || value === null || Array.isArray(value) || ArrayBuffer.isView(value)) {
    throw typeError(name, value, expected);
  }
  return value;
}

export function needNumber(name, value, expected = "a number is") {
  if (typeof value !== "number") {
    throw typeError(name, value, expected);
  }
  return value;
}

export function needFinite(name, value, expected = "a finite number is") {
  if (!Number.isFinite(needNumber(name, value, expected))) {
    throw rangeError(name, value, expected);
  }
  return value;
}

/** An array of so many numbers. */
export function needVector(name, value, size, finite = "finite components are") {
  const good = (Array.isArray(value) || ArrayBuffer.isView(value)) && value.length === size;
  if (!good || !Array.prototype.every.call(value, (c) => typeof c === "number")) {
    throw typeError(name, value, `an array of ${size} numbers is`);
  }
  const numbers = Array.from(value);
  if (!numbers.every(Number.isFinite)) {
    throw rangeError(name, value, finite);
  }
  return numbers;
}

export function needWord(name, value, words) {
  const place = typeof value === "string" ? words.findIndex((word) => sameWord(word, value)) : -1;
  if (place < 0) {
    throw typeError(name, value, `${listed(words)} is`);
  }
  return place;
}

// What the values of a parameter are, as the setters of C++ say it.
function expectation({ kind, minimum, maximum, minimumOpen }) {
  switch (kind) {
    case "color":
      return minimum === null ? "finite components are" : `finite components of at least ${minimum} are`;
    case "range":
      return "two finite numbers of which the first is not the larger are";
  }
  if (minimum !== null && maximum !== null) {
    return `a number in [${minimum}, ${maximum}] is`;
  }
  const number = kind === "length" ? "a number" : "a finite number";
  return minimum === null
    ? `${number} is`
    : `${number} ${minimumOpen ? "above" : "of at least"} ${minimum} is`;
}

/** The value of a parameter, as a number, a boolean, an array, or the place of a choice. */
export function readParameter(row, name, value) {
  const expected = expectation(row);
  switch (row.kind) {
    case "flag":
      if (typeof value !== "boolean") {
        throw typeError(name, value, "true or false is");
      }
      return value;
    case "choice": {
      const place = row.choices.findIndex(
        (choice) =>
          typeof value === "string" && (sameWord(choice.name, value) || sameWord(choice.word, value)),
      );
      if (place < 0) {
        throw typeError(name, value, `${listed(row.choices.map((choice) => choice.word))} is`);
      }
      return place;
    }
    case "color":
    case "range": {
      const size = row.kind === "color" ? 3 : 2;
      const numbers = needVector(name, value, size, expected);
      if (row.minimum !== null && numbers.some((c) => c < row.minimum)) {
        throw rangeError(name, value, expected);
      }
      if (row.kind === "range" && numbers[0] > numbers[1]) {
        throw rangeError(name, value, expected);
      }
      return numbers;
    }
    default: {
      const number = row.kind === "length" && value === "infinite" ? Infinity : value;
      needNumber(name, number, row.kind === "length" ? 'a number or "infinite" is' : "a number is");
      if (row.kind === "count" && !Number.isInteger(number) && Number.isFinite(number)) {
        throw typeError(name, value, "a whole number is");
      }
      const low = row.minimum === null ? -Infinity : row.minimum;
      const high = row.maximum === null ? Infinity : row.maximum;
      const inside = (row.minimumOpen ? number > low : number >= low) && number <= high;
      if (!inside || (!Number.isFinite(number) && row.kind !== "length")) {
        throw rangeError(name, value, expected);
      }
      return number;
    }
  }
}

/** The default of a parameter, as readParameter() gives it. */
export function defaultOf(row) {
  switch (row.kind) {
    case "flag":
      return row.default[0] !== 0;
    case "color":
    case "range":
      return [...row.default];
    default:
      return row.default[0] ?? Infinity;
  }
}

const automaticOf = (row, rows) => rows.find((other) => other.name === `Automatic${row.name}`);

/**
 * Values of rows by their keys, defaults where none is given. A parameter that can be automatic takes
 * "auto"; any other value turns that off, unless the switch of its own is given, too.
 */
export function readParameters(rows, path, options) {
  const values = {};
  for (const row of rows) {
    values[row.key] ??= defaultOf(row);
    const value = options[row.key];
    const automatic = automaticOf(row, rows);
    if (value === undefined) {
      continue;
    }
    if (automatic && value === "auto") {
      values[automatic.key] = true;
    } else {
      values[row.key] = readParameter(row, path + row.key, value);
      if (automatic) {
        values[automatic.key] = false;
      }
    }
  }
  return values;
}
