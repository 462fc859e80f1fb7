// SPDX-License-Identifier: BSD-3-Clause
//
// The panel: every control, made of the package's list of parameters. A control shows a part of the state, and
// asks the page to change it.

import {
  button,
  check,
  color,
  pictureRow,
  radios,
  row,
  section,
  select,
  slider,
  titleOf,
  wide,
} from "./controls.js";
import { extentOf, middleHeight, otherKind } from "./lights.js";
import { presetNames } from "reliefshading";
import { colorToHex, hexToColor, rowOf, usualOf } from "./scene.js";
import { heightsSection } from "./source-section.js";

const presetHelp = {
  default: "One sun in the north-west",
  multidirectional: "A sun from each of four sides",
  "sky-dome": "A sky that is white all over",
  "sun-and-sky": "A sun and the clear sky about it",
  combined: "A sun, with slopes darkened by their steepness",
  igor: "Light by aspect and slope alone, soft and without shadows",
};
const capital = (word) => word[0].toUpperCase() + word.slice(1).replaceAll("-", " ");

export class Panel {
  /** @param page   field, state; change…(), and what its buttons do */
  constructor(form, page) {
    this.page = page;
    this.shows = []; // functions that bring controls up to date
    this.ranges = []; // and those that the field decides the ends of
    form.addEventListener("submit", (event) => event.preventDefault());
    form.append(
      heightsSection(page, this.shows),
      this.presetSection(),
      this.lightSection(),
      this.reliefSection(),
      this.colorSection(),
      this.highlightSection(),
      this.backlightSection(),
      this.environmentSection(),
      this.pictureSection(),
      this.fileSection(),
    );
  }

  show() {
    this.shows.forEach((show) => show());
  }

  fieldChanged() {
    this.ranges.forEach((range) => range());
  }

  //------------------------------------------------------------------------------------------------
  // Parameters of scene and material, which the scene has side by side.

  valueOf(row) {
    return this.page.state.scene[row.key] ?? usualOf(row);
  }

  onEnd() {
    return () => this.page.endGesture();
  }

  // A number. Lengths and densities are those of the field's spacing.
  number(owner, key, label, { range, active } = {}) {
    const parameter = rowOf(owner, key);
    const control = slider({
      label: label ?? parameter.label,
      title: titleOf(parameter),
      range: parameter.slider,
      low: parameter.minimum,
      high: parameter.maximum,
      whole: parameter.kind === "count",
      onInput: (value) => this.page.changeScene({ [key]: value }, key),
      onEnd: this.onEnd(),
    });
    const [from, to] = parameter.slider;
    this.ranges.push(() => {
      const { spacing } = this.page.field;
      const unit = (spacing[0] + spacing[1]) / 2;
      const factor = parameter.unit === "spacing" ? unit : parameter.unit === "1/spacing" ? 1 / unit : 1;
      control.setRange(...(range?.() ?? [from * factor, to * factor]));
    });
    this.shows.push(() => {
      const value = this.valueOf(parameter);
      control.show(value === "auto" ? this.page.automatic(key) : value);
      control.enable(active?.() ?? true);
    });
    return control.element;
  }

  flag(owner, key, label, on = true, off = false) {
    const parameter = rowOf(owner, key);
    const control = check({
      label: label ?? parameter.label,
      title: titleOf(parameter),
      onChange: (checked) => this.page.changeScene({ [key]: checked ? on : off }),
    });
    this.shows.push(() => control.show(this.valueOf(parameter) === on));
    return control.element;
  }

  // Whether a number is found by itself, "auto" in the scene.
  automatic(owner, key, label, isAuto, start) {
    const control = check({
      label,
      title: titleOf(rowOf(owner, `automatic${capital(key).replaceAll(" ", "")}`)),
      onChange: (checked) => this.page.changeScene({ [key]: checked ? "auto" : start() }),
    });
    this.shows.push(() => control.show(isAuto()));
    return control.element;
  }

  choice(owner, key, label) {
    const parameter = rowOf(owner, key);
    const control = select({
      label: label ?? parameter.label,
      title: titleOf(parameter),
      options: parameter.choices.map(({ word }) => [word, capital(word)]),
      onChange: (value) => this.page.changeScene({ [key]: value }),
    });
    this.shows.push(() => control.show(this.valueOf(parameter)));
    return control.element;
  }

  // A colour, and a picture that may take its place.
  tint(key, label, texture) {
    const parameter = rowOf("material", key);
    const control = color({
      label,
      title: titleOf(parameter),
      onInput: (hex) => this.page.changeScene({ [key]: hexToColor(hex) }, key),
      onEnd: this.onEnd(),
    });
    this.shows.push(() => control.show(colorToHex(this.valueOf(parameter))));
    return [
      control.element,
      this.image(texture, `${label} image`, "A picture over the whole relief in place of the colour"),
    ];
  }

  image(role, label, title) {
    const control = pictureRow({
      label,
      title,
      role,
      onOpen: () => this.page.chooseImage(role),
      onRemove: () => this.page.removeImage(role),
    });
    this.shows.push(() => control.show(this.page.imageName(role)));
    return control.element;
  }

  // Both ends of a range; one pushes the other.
  ends(key, label) {
    const parameter = rowOf("material", key);
    return [0, 1].map((k) => {
      const control = slider({
        label: `${label} ${k === 0 ? "from" : "to"}`,
        title: titleOf(parameter),
        range: parameter.slider,
        onInput: (value) => {
          const pair = [...this.valueOf(parameter)];
          pair[k] = value;
          pair[1 - k] = k === 0 ? Math.max(pair[1], value) : Math.min(pair[0], value);
          this.page.changeScene({ [key]: pair }, `${key}${k}`);
        },
        onEnd: this.onEnd(),
      });
      this.shows.push(() => control.show(this.valueOf(parameter)[k]));
      return control.element;
    });
  }

  //------------------------------------------------------------------------------------------------
  light() {
    const { scene, selected } = this.page.state;
    return scene.lights[selected];
  }

  presetSection() {
    const group = wide(
      ...["default", ...presetNames.filter((name) => name !== "default")].map((name) =>
        button(capital(name), `${presetHelp[name]}, in place of the lights`, () =>
          this.page.applyPreset(name),
        ),
      ),
    );
    group.setAttribute("role", "group");
    group.setAttribute("aria-label", "Ways to light");
    group.classList.add("alone");
    return section("Ways to light", group);
  }

  lightSection() {
    const { page } = this;
    const change = (values, gesture) => page.changeLight({ ...this.light(), ...values }, gesture);
    const which = select({
      label: "Light",
      title: "The light that is moved",
      options: [],
      onChange: (value) => page.select(Number(value)),
    });
    const add = button("Add", "Another light", () => page.addLight());
    const remove = button("Remove", "Take this light away", () => page.removeLight());
    const on = check({
      label: "Shines",
      title: titleOf(rowOf("light", "on")),
      onChange: (value) => change({ on: value }),
    });
    const kind = radios({
      label: "Kind",
      options: [
        ["point", "Point", "A light at a place"],
        ["sun", "Sun", "A light that is infinitely far away"],
      ],
      onChange: () => page.changeLight(otherKind(this.light(), page.field, page.state.scene)),
    });
    this.shows.push(() => {
      const { lights } = page.state.scene;
      which.fill(lights.map((light, k) => [k, `${k + 1}: ${light.kind === "sun" ? "sun" : "point"}`]));
      which.show(page.state.selected);
      remove.disabled = lights.length < 2;
      on.show(this.light().on !== false);
      kind.show(this.light().kind);
    });
    return section(
      "Light",
      which.element,
      row("", null, "", wide(add, remove)),
      on.element,
      kind.element,
      ...this.lightPlace(change),
      this.ofLight("intensity", "Intensity", change),
      this.lightColor(change),
    );
  }

  lightPlace(change) {
    const { page } = this;
    const plain = (label, title, range, onInput) =>
      slider({ label, title, range, onInput, onEnd: this.onEnd() });
    const distance = plain(
      "Distance",
      "Height of the lamp above the middle of the relief, in the unit of lengths.",
      [0, 1, 2],
      (value) => {
        const [x, y] = this.light().position;
        change({ position: [x, y, middleHeight(page.field, page.state.scene) + value] }, "distance");
      },
    );
    // Below the relief, too, where light comes through.
    this.ranges.push(() => {
      const far = 2 * Math.max(...extentOf(page.field));
      distance.setRange(page.state.scene.useFloor ? -far / 2 : 0, far);
    });
    const angle = (key, label, title, range) => {
      const control = slider({
        label,
        title,
        range,
        low: key === "altitude" ? -90 : undefined,
        high: key === "altitude" ? 90 : undefined,
        onInput: (value) => change({ [key]: value, toward: undefined }, key),
        onEnd: this.onEnd(),
      });
      return { key, control };
    };
    const angles = [
      angle("azimuth", "Azimuth", "Where the sun stands, in degrees clockwise from north.", [0, 360, 1]),
      angle("altitude", "Altitude", "How high the sun stands, in degrees above the horizon.", [0, 90, 1]),
    ];
    const diameter = this.ofLight("angularDiameter", "Diameter", change);
    this.ranges.push(() => angles[1].control.setRange(page.state.scene.useFloor ? -90 : 0, 90));
    this.shows.push(() => {
      const light = this.light();
      const sun = light.kind === "sun";
      distance.element.hidden = sun;
      diameter.hidden = !sun;
      angles.forEach(({ key, control }) => {
        control.element.hidden = !sun;
        if (sun) {
          control.show(light[key]);
        }
      });
      if (!sun) {
        distance.show(light.position[2] - middleHeight(page.field, page.state.scene));
      }
    });
    return [distance.element, ...angles.map(({ control }) => control.element), diameter];
  }

  ofLight(key, label, change) {
    const parameter = rowOf("light", key);
    const control = slider({
      label,
      title: titleOf(parameter),
      range: parameter.slider,
      low: parameter.minimum,
      high: parameter.maximum,
      onInput: (value) => change({ [key]: value }, key),
      onEnd: this.onEnd(),
    });
    this.shows.push(() => control.show(this.light()[key] ?? usualOf(parameter)));
    return control.element;
  }

  lightColor(change) {
    const parameter = rowOf("light", "color");
    const control = color({
      label: "Colour",
      title: titleOf(parameter),
      onInput: (hex) => change({ color: hexToColor(hex) }, "color"),
      onEnd: this.onEnd(),
    });
    this.shows.push(() => control.show(colorToHex(this.light().color ?? usualOf(parameter))));
    return control.element;
  }

  //------------------------------------------------------------------------------------------------
  reliefSection() {
    const { page } = this;
    const depth = rowOf("material", "subsurfaceDepth");
    const automatic = () => (page.state.scene.subsurfaceDepth ?? "auto") === "auto";
    // Without a unit heights get a scale that fits them, which may be far from 1.
    const heights = () => (page.field.lengths ? [0, 10] : [0, 5 * page.field.fittedScale]);
    const depthControl = slider({
      label: depth.label,
      title: titleOf(depth, "length"),
      range: depth.slider,
      low: 0,
      onInput: (value) => page.changeScene({ subsurfaceDepth: value }, "subsurfaceDepth"),
      onEnd: this.onEnd(),
    });
    this.ranges.push(() => depthControl.setRange(0, depth.slider[1] * page.automatic("subsurfaceDepth")));
    this.shows.push(() => {
      depthControl.show(automatic() ? page.automatic("subsurfaceDepth") : page.state.scene.subsurfaceDepth);
    });
    const exponential = () => (page.state.scene.attenuation ?? "reciprocal") === "exponential";
    return section(
      "Relief",
      this.number("scene", "heightScale", "Height scale", { range: heights }),
      depthControl.element,
      this.automatic("material", "subsurfaceDepth", "Automatic depth", automatic, () =>
        page.automatic("subsurfaceDepth"),
      ),
      this.choice("material", "offsetMode", "Way down"),
      this.choice("material", "attenuation"),
      this.number("material", "density", null, { active: exponential }),
      this.choice("scene", "response"),
      this.image(
        "mask",
        "Mask",
        "Where the picture is black or transparent there is no relief; it has the size of the heights",
      ),
    );
  }

  colorSection() {
    return section(
      "Colours",
      ...this.tint("diffuseColor", "Diffuse", "diffuse"),
      ...this.tint("baseColor", "Base", "base"),
    );
  }

  highlightSection() {
    return section(
      "Highlights",
      this.number("material", "specularCoefficient", "Share k_s"),
      ...this.tint("specularColor", "Specular", "specular"),
      ...this.ends("specularRange", "Range"),
      this.number("material", "specularPower"),
    );
  }

  backlightSection() {
    const { page } = this;
    const floor = () => page.state.scene.useFloor ?? false;
    const levels = () => {
      const scale = page.state.scene.heightScale ?? 1;
      const [a, b] = [page.field.bottom * scale, page.field.top * scale];
      return [Math.min(a, b) - Math.abs(b - a), Math.max(a, b)];
    };
    const control = check({
      label: "Floor",
      title: titleOf(rowOf("material", "useFloor")),
      onChange: (on) =>
        page.changeScene(
          on && page.state.scene.floorHeight === undefined
            ? { useFloor: on, floorHeight: page.floorBelow() }
            : { useFloor: on },
        ),
    });
    this.shows.push(() => control.show(floor()));
    return section(
      "Light from behind",
      this.number("material", "forwardScatterCoefficient", "Share k_f"),
      ...this.ends("forwardScatterRange", "Range"),
      this.number("material", "forwardScatterPower"),
      control.element,
      this.number("material", "floorHeight", null, { range: levels, active: floor }),
    );
  }

  //------------------------------------------------------------------------------------------------
  environmentSection() {
    const { page } = this;
    const environment = () => page.state.scene.environment ?? null;
    const on = check({
      label: "Light from all around",
      title: "An environment, beside the lights",
      onChange: (checked) => page.setEnvironment(checked ? { image: "whiteDome", intensity: 0.5 } : null),
    });
    const image = select({
      label: "Image",
      title: "What is around: a sky, or a picture by longitude and latitude whose upper edge is the zenith",
      options: [
        ["whiteDome", "White dome"],
        ["clearSky", "Clear sky"],
        ["file", "Picture…"],
      ],
      onChange: (value) => page.setEnvironmentImage(value),
    });
    const number = (key, label) => {
      const parameter = rowOf("environment", key);
      const control = slider({
        label: label ?? parameter.label,
        title: titleOf(parameter),
        range: parameter.slider,
        low: parameter.minimum,
        high: parameter.maximum,
        whole: parameter.kind === "count",
        onInput: (value) => page.changeEnvironment({ [key]: value }, key),
        onEnd: this.onEnd(),
      });
      this.shows.push(() => control.show(environment()?.[key] ?? usualOf(parameter)));
      return control.element;
    };
    const sampling = rowOf("environment", "sampling");
    const spread = select({
      label: sampling.label,
      title: titleOf(sampling),
      options: sampling.choices.map(({ word }) => [word, capital(word)]),
      onChange: (value) => page.changeEnvironment({ sampling: value }),
    });
    const turning = check({
      label: "Drag turns the environment",
      title: "Dragging over the picture, and arrow keys, turn the environment instead of moving a light",
      onChange: (checked) => page.setTurning(checked),
    });
    const radius = rowOf("environment", "radius");
    const far = check({
      label: "Infinitely far away",
      title: titleOf(radius),
      onChange: (checked) =>
        page.changeEnvironment({ radius: checked ? usualOf(radius) : 2 * Math.max(...extentOf(page.field)) }),
    });
    const distance = slider({
      label: "Radius",
      title: titleOf(radius, "length"),
      range: [0, 1, 2],
      onInput: (value) => page.changeEnvironment({ radius: value }, "radius"),
      onEnd: this.onEnd(),
    });
    this.ranges.push(() => {
      const length = Math.max(...extentOf(page.field));
      distance.setRange(length / 10, 10 * length);
    });
    const sky = slider({
      label: "Sun's altitude",
      title: "Altitude of the sun in the clear sky, which is without its disc, in degrees.",
      range: [0, 90, 1],
      low: 0,
      high: 90,
      onInput: (value) => page.changeEnvironment({ altitude: value }, "sky"),
      onEnd: this.onEnd(),
    });
    const rows = [
      image.element,
      this.image("environment", "Picture", "A picture by longitude and latitude"),
      sky.element,
      number("intensity"),
      number("rotationZ"),
      number("tilt"),
      number("numberOfSamples"),
      spread.element,
      far.element,
      distance.element,
      turning.element,
    ];
    this.shows.push(() => {
      const given = environment();
      on.show(given !== null);
      rows.forEach((element) => (element.hidden = given === null));
      image.show(given?.image ?? "whiteDome");
      rows[1].hidden = given?.image !== "file";
      rows[2].hidden = given?.image !== "clearSky";
      sky.show(given?.altitude ?? 45);
      spread.show(given?.sampling ?? usualOf(sampling));
      const infinite = typeof (given?.radius ?? usualOf(radius)) !== "number";
      far.show(infinite);
      distance.element.hidden = given === null || infinite;
      distance.show(infinite ? 0 : given.radius);
      turning.show(page.turning);
    });
    return section("Environment", on.element, ...rows);
  }

  //------------------------------------------------------------------------------------------------
  pictureSection() {
    const { page } = this;
    const automatic = () => page.state.scene.exposure === "auto";
    const stepping = () => page.state.scene.integrator === "fixed-step";
    return section(
      "Picture",
      this.number("scene", "exposure", null, { active: () => !automatic() }),
      this.automatic("scene", "exposure", "Automatic exposure", automatic, () => 0),
      this.number("scene", "numberOfSunSamples"),
      this.choice("scene", "integrator"),
      this.number("scene", "tolerance", null, { active: () => !stepping() }),
      this.number("scene", "numberOfSteps", null, { active: stepping }),
    );
  }

  fileSection() {
    const { page } = this;
    return section(
      "Files",
      wide(
        button("Save picture", "PNG in full resolution, by the exact sums", () => page.savePicture()),
        button("Save scene", "The file that reliefshade --scene takes", () => page.saveScene()),
        button("Open scene…", "A scene's file", () => page.chooseScene()),
        button("Copy link", "A link that has the scene; pictures that were opened are not in it", () =>
          page.copyLink(),
        ),
        button("Check", "Compares what is shown with the exact sums", () => page.check()),
      ),
    );
  }
}
