// SPDX-License-Identifier: BSD-3-Clause
//
// The page: what is open, the scene and its history, and what buttons, keys and dropped files do.

import { make } from "./controls.js";
import { callFiles, choose, download, openFile } from "./files.js";
import { Gestures } from "./gestures.js";
import { History } from "./history.js";
import { carriedOver, describe, extentOf, LightDots, middleHeight } from "./lights.js";
import { Panel } from "./panel.js";
import { Picture, workersFor } from "./picture.js";
import { createWorkerShader, fitHeightScale, init } from "reliefshading";
import {
  fromLink,
  readSceneFile,
  sceneFile,
  shadeOptions,
  toCode,
  toLink,
  usualSun,
  withPreset,
} from "./scene.js";
import { View } from "./view.js";

const find = (selector) => document.querySelector(selector);
const noImages = { base: null, diffuse: null, specular: null, mask: null, environment: null };
const pictureFiles = ".png,.tif,.tiff,.exr,.hdr,.jpg,.jpeg,.webp,.bmp,image/*";
const heightFiles = `${pictureFiles},.obj`;
const mostPixels = 2048; // along a side of the canvas

/** The least and the greatest height. */
function rangeOf(heights) {
  let [bottom, top] = [Infinity, -Infinity];
  for (const value of heights) {
    if (Number.isFinite(value)) {
      bottom = Math.min(bottom, value);
      top = Math.max(top, value);
    }
  }
  return { bottom, top };
}

/** The heights of an example. */
function readExample({ file }) {
  const { href } = new URL(`examples/${file}`, import.meta.url);
  return callFiles({ what: "heights", name: file, address: href });
}

const sizeOf = ({ width, height, spacing }) => ({ width, height, spacing });

class Page {
  constructor(examples) {
    this.examples = examples;
    this.assets = new Map(); // pixels that were opened, by names that the state has
    this.field = null;
    this.readings = 0; // of files of heights
    this.turning = false;
    this.history = new History(() => this.update(true));
    const on = {
      wrong: (error) => this.alert(error.message),
      busy: (busy) => (find("#busy").hidden = !busy),
      told: (text) => this.alert(text),
      host: (name) => (document.documentElement.dataset.host = name),
      lost: (lost) =>
        lost
          ? this.alert("The graphics processor was lost; the picture comes back with it.")
          : this.alert(""),
    };
    const host = new URLSearchParams(location.search).get("host");
    this.picture = new Picture(find("#canvas"), this.assets, on, host);
    this.view = new View(() => this.look(true));
    this.dots = new LightDots(find("#frame"), this);
    this.gestures = new Gestures(find("#frame"), this);
    this.panel = new Panel(find("#panel"), this);
    this.listen();
  }

  get state() {
    return this.history.state;
  }

  //------------------------------------------------------------------------------------------------
  listen() {
    const list = find("#example");
    list.append(
      ...this.examples.map(({ name, label }) => make("option", { value: name, textContent: label })),
    );
    list.append(make("option", { value: "", textContent: "Own file", disabled: true }));
    list.addEventListener("change", () => this.guard(() => this.openExample(list.value)));
    find("#open").addEventListener("click", () =>
      choose(heightFiles, (file) => this.guard(() => this.open(file, "heights"))),
    );
    find("#undo").addEventListener("click", () => this.history.undo());
    find("#redo").addEventListener("click", () => this.history.redo());
    find("#reset").addEventListener("click", () => this.reset());
    find("#larger").addEventListener("click", () => this.view.zoomBy(1.5));
    find("#smaller").addEventListener("click", () => this.view.zoomBy(1 / 1.5));
    find("#fit").addEventListener("click", () => this.view.fit());
    find("#alert button").addEventListener("click", () => this.alert(""));
    document.addEventListener("keydown", (event) => this.key(event));
    window.addEventListener("hashchange", () => this.guard(() => this.openLink()));
    new ResizeObserver(() => this.layOut()).observe(find("#stage"));
    for (const kind of ["dragenter", "dragover", "dragleave", "drop"]) {
      document.addEventListener(kind, (event) => this.dropped(event));
    }
  }

  key(event) {
    const command = (event.ctrlKey || event.metaKey) && !event.altKey;
    const typing = event.target instanceof HTMLInputElement && event.target.type === "number";
    if (!command || typing) {
      return;
    }
    const key = event.key.toLowerCase();
    if (key === "z" || key === "y") {
      event.preventDefault();
      if (key === "y" || event.shiftKey) {
        this.history.redo();
      } else {
        this.history.undo();
      }
    }
  }

  dropped(event) {
    event.preventDefault();
    const target =
      event.target instanceof Element
        ? (event.target.closest("[data-drop]") ?? find("#stage"))
        : find("#stage");
    document.querySelectorAll(".target").forEach((element) => element.classList.remove("target"));
    if (event.type === "dragenter" || event.type === "dragover") {
      target.classList.add("target");
    }
    const file = event.type === "drop" ? event.dataTransfer.files[0] : undefined;
    if (file) {
      this.guard(() =>
        /\.json$/i.test(file.name) ? this.openScene(file) : this.open(file, target.dataset.drop ?? "heights"),
      );
    }
  }

  /** Runs what may go wrong, and says in one line if it does. */
  async guard(body) {
    this.alert("");
    document.body.setAttribute("aria-busy", "true");
    try {
      return await body();
    } catch (error) {
      this.alert(error.message);
      return undefined;
    } finally {
      document.body.removeAttribute("aria-busy");
    }
  }

  alert(text) {
    const box = find("#alert");
    box.hidden = text === "";
    box.firstElementChild.textContent = text;
  }

  say(text) {
    find("#readout").textContent = text;
  }

  //------------------------------------------------------------------------------------------------
  // What is open.

  async openExample(name, scene, reading) {
    const example = this.examples.find((one) => one.name === name) ?? this.examples[0];
    const read = await (reading ?? readExample(example));
    await this.show(
      { ...read, ...example.field, name: example.file, example: example.name },
      scene ?? example.scene,
    );
  }

  /** @param reading   heights of the first example, if they are on their way */
  async openLink(reading) {
    let link = null;
    try {
      link = await fromLink(location.hash);
    } catch (error) {
      await this.openExample("");
      throw error;
    }
    await this.openExample(link?.example ?? "", link?.scene, link ? undefined : reading);
  }

  /** Opens a file of heights, or of a picture that the scene has. */
  async open(file, role) {
    if (role === "heights") {
      await this.openHeights(file);
      return;
    }
    const picture = await openFile(file, role === "mask" ? "mask" : "picture");
    if (role === "mask" && (picture.width !== this.field.width || picture.height !== this.field.height)) {
      throw new Error(
        `“${file.name}” has ${picture.width} × ${picture.height} pixels, a mask needs the heights' ${this.field.width} × ${this.field.height}.`,
      );
    }
    const id = `${file.name}#${this.assets.size}`;
    this.assets.set(id, picture);
    const { scene, images } = this.state;
    const next = { ...this.state, images: { ...images, [role]: id } };
    if (role === "environment") {
      const { azimuth, altitude, turbidity, ...rest } = scene.environment ?? {};
      next.scene = { ...scene, environment: { ...rest, image: "file", file: file.name } };
    }
    this.history.change(next);
  }

  /** Opens heights, in one of the ways of sources.js; over those of the same file the scene stays. */
  async openHeights(file, how) {
    const reading = ++this.readings;
    const { warnings = [], source, ...field } = await openFile(file, "heights", how);
    if (reading !== this.readings) {
      return; // another one was wanted meanwhile
    }
    const next = { ...field, example: "", source: source ? { ...source, file } : undefined };
    if (how) {
      await this.showAgain(next);
    } else {
      await this.show(next);
    }
    if (warnings.length > 0) {
      this.alert(warnings.join(" "));
    }
  }

  // A field of the same file, with the scene that is there.
  async showAgain(field) {
    const { scene, images } = this.state;
    const heightScale = field.lengths ? 1 : await fitHeightScale(field.heights, sizeOf(field));
    const next = carriedOver(scene, this.whole, { ...field, ...rangeOf(field.heights) }, heightScale);
    await this.show(field, next, { ...images, mask: null });
  }

  /** Reads the file of the heights in another way. */
  async rereadHeights(values) {
    const { file, how } = this.whole.source;
    await this.guard(() => this.openHeights(file, { ...how, ...values }));
    this.panel.show(); // as it is now, if that could not be
  }

  // Another field, with a scene that suits it.
  async show(field, scene, images) {
    const { heights } = field;
    // Only where it is not told otherwise: it is to be found first.
    const fittedScale = field.lengths
      ? 1
      : (scene?.heightScale ?? (await fitHeightScale(heights, sizeOf(field))));
    this.readings += 1;
    this.whole = { ...field, ...rangeOf(heights), fittedScale };
    this.field = this.whole;
    this.shownMask = null;
    if (!images) {
      this.assets.clear();
    }
    this.picture.setField(this.field);
    this.view.setField(this.field);
    this.first = { scene: scene ?? this.usualScene(), selected: 0, images: images ?? noImages };
    this.history.begin(this.first);
    this.ends = null;
    find("#example").value = field.example;
    this.layOut();
    this.update(false);
    this.picture.first.then(() => (find("#stage").inert = find("#panel").inert = false));
  }

  usualScene() {
    const scale = this.field.lengths ? {} : { heightScale: this.field.fittedScale };
    return { ...scale, lights: [{ ...usualSun, altitude: 35 }] };
  }

  // Without the samples that the mask leaves out.
  applyMask() {
    const id = this.state.images.mask;
    if (id === this.shownMask) {
      return;
    }
    this.shownMask = id;
    const mask = this.assets.get(id)?.data;
    const heights = mask ? this.whole.heights.map((value, k) => (mask[k] ? value : NaN)) : this.whole.heights;
    this.field = { ...this.whole, heights, ...rangeOf(heights) };
    this.picture.setField(this.field);
  }

  //------------------------------------------------------------------------------------------------
  // Changes.

  changeScene(values, gesture) {
    const { scene } = this.state;
    this.history.change({ ...this.state, scene: { ...scene, ...values } }, gesture);
  }

  changeLight(light, gesture) {
    const { scene, selected } = this.state;
    // What is undefined is not there, in files and links.
    const plain = Object.fromEntries(Object.entries(light).filter(([, value]) => value !== undefined));
    this.changeScene({ lights: scene.lights.map((one, k) => (k === selected ? plain : one)) }, gesture);
  }

  select(k) {
    // No step of its own in the history.
    this.history.state = { ...this.state, selected: k };
    this.update(false);
  }

  addLight() {
    const { scene } = this.state;
    const [w, h] = extentOf(this.field);
    const [x, y] = this.field.origin;
    const z = middleHeight(this.field, scene) + Math.max(w, h) / 3;
    const light = {
      kind: "point",
      position: [x + 0.7 * w, y + 0.7 * h, z].map((c) => Number(c.toPrecision(9))),
    };
    this.history.change({
      ...this.state,
      scene: { ...scene, lights: [...scene.lights, light] },
      selected: scene.lights.length,
    });
  }

  removeLight() {
    const { scene, selected } = this.state;
    const lights = scene.lights.filter((_, k) => k !== selected);
    this.history.change({ ...this.state, scene: { ...scene, lights }, selected: Math.max(selected - 1, 0) });
  }

  applyPreset(name) {
    return this.guard(async () => {
      const { scene, images } = this.state;
      const next = await withPreset(scene, name);
      this.history.change({ scene: next, selected: 0, images: { ...images, environment: null } });
    });
  }

  setEnvironment(environment) {
    const { environment: before, ...scene } = this.state.scene;
    this.history.change({ ...this.state, scene: environment ? { ...scene, environment } : scene });
  }

  changeEnvironment(values, gesture) {
    this.changeScene({ environment: { ...this.state.scene.environment, ...values } }, gesture);
  }

  setEnvironmentImage(image) {
    const { azimuth, altitude, turbidity, file, ...rest } = this.state.scene.environment;
    if (image === "file") {
      this.panel.show(); // until there is a file
      this.chooseImage("environment");
    } else if (image === "clearSky") {
      const sun = this.state.scene.lights.find(({ kind }) => kind === "sun") ?? usualSun;
      this.setEnvironment({ ...rest, image, azimuth: sun.azimuth, altitude: Math.max(sun.altitude, 0) });
    } else {
      this.setEnvironment({ ...rest, image });
    }
  }

  setTurning(turning) {
    this.turning = turning;
    this.update(false);
  }

  chooseImage(role) {
    choose(pictureFiles, (file) => this.guard(() => this.open(file, role)));
  }

  removeImage(role) {
    const { images } = this.state;
    const next = { ...this.state, images: { ...images, [role]: null } };
    if (role === "environment") {
      const { file, ...rest } = this.state.scene.environment;
      next.scene = { ...this.state.scene, environment: { ...rest, image: "whiteDome" } };
    }
    this.history.change(next);
  }

  imageName(role) {
    const id = this.state.images[role];
    const missing = role === "environment" ? this.state.scene.environment?.file : undefined;
    return id ? id.replace(/#\d+$/, "") : missing ? `${missing} (to be opened)` : null;
  }

  /** What a value is that is found by itself. */
  automatic(key) {
    return key === "subsurfaceDepth" ? (this.field.spacing[0] + this.field.spacing[1]) / 2 : 0;
  }

  floorBelow() {
    const scale = this.state.scene.heightScale ?? 1;
    const [a, b] = [this.field.bottom * scale, this.field.top * scale];
    return Number((Math.min(a, b) - 0.1 * Math.abs(b - a)).toPrecision(6));
  }

  endGesture() {
    this.history.endGesture();
  }

  cancelGesture() {
    this.history.cancelGesture();
  }

  reset() {
    if (this.state !== this.first) {
      this.history.change(this.first);
    }
  }

  //------------------------------------------------------------------------------------------------
  // Brings everything up to date with the state.
  update(moving) {
    const { scene, selected } = this.state;
    if (selected >= scene.lights.length) {
      this.history.state = { ...this.state, selected: 0 };
    }
    this.applyMask();
    // Where sliders end.
    const ends = `${scene.heightScale} ${scene.useFloor}`;
    if (this.ends !== ends) {
      this.ends = ends;
      this.panel.fieldChanged();
    }
    this.picture.setState(this.state, moving);
    this.panel.show();
    this.dots.show();
    find("#undo").disabled = this.history.past.length === 0;
    find("#redo").disabled = this.history.future.length === 0;
    this.tellLight();
  }

  tellLight() {
    const { scene, selected } = this.state;
    const zoom = this.view.isWhole ? "" : `; zoom ${(100 * this.view.zoom).toFixed(0)} %`;
    this.say(describe(scene.lights[selected], this.field, scene) + zoom);
  }

  // Another part of the relief is seen.
  look(moving) {
    this.picture.setView(this.view, moving);
    this.dots.show();
    find("#smaller").disabled = find("#fit").disabled = this.view.isWhole;
    find("#larger").disabled = this.view.isLargest;
    this.tellLight();
  }

  // The picture fills the room that there is.
  layOut() {
    if (!this.field) {
      return;
    }
    const frame = find("#frame");
    const size = [frame.clientWidth, frame.clientHeight];
    const ratio = Math.min(window.devicePixelRatio || 1, mostPixels / Math.max(...size));
    this.picture.resize(...size.map((length) => Math.max(Math.round(length * ratio), 1)));
    this.view.setRoom(...size);
    if (this.state.scene) {
      this.look(false);
    }
  }

  //------------------------------------------------------------------------------------------------
  // Files of the picture and of the scene.

  /** The picture in full resolution, by the exact sums. */
  async exact() {
    const options = shadeOptions(this.state, this.field, this.assets);
    const shader = createWorkerShader({ workers: workersFor(this.field) });
    try {
      return await shader.shade(this.field.heights, options);
    } finally {
      shader.terminate();
    }
  }

  baseName() {
    return this.field.name.replace(/\.[^.]*$/, "");
  }

  savePicture() {
    return this.guard(async () => {
      this.say("The picture is being made …");
      const { data, width, height } = await this.exact();
      const png = await callFiles({ what: "png", picture: { data, width, height } }, [data.buffer]);
      download(`${this.baseName()}-shaded.png`, png.data, "image/png");
      this.say(`Saved: ${width} × ${height} pixels.`);
    });
  }

  sceneText() {
    return sceneFile(this.state);
  }

  saveScene() {
    return this.guard(async () => {
      download(`${this.baseName()}-scene.json`, await this.sceneText(), "application/json");
      this.say("The scene is saved.");
    });
  }

  chooseScene() {
    choose(".json,application/json", (file) => this.guard(() => this.openScene(file)));
  }

  async openScene(file) {
    if (file.size > 2 ** 22) {
      throw new Error(`“${file.name}” cannot be opened: it is too large for a scene.`);
    }
    let scene;
    try {
      scene = await readSceneFile(await file.text());
    } catch (error) {
      throw new Error(`“${file.name}” cannot be opened: ${error.message}.`);
    }
    const environment = scene.environment?.image === "file" ? null : this.state.images.environment;
    this.history.change({ scene, selected: 0, images: { ...this.state.images, environment } });
    if (scene.environment?.image === "file") {
      this.alert(
        `The scene's environment is the picture “${scene.environment.file}”: open it under Environment.`,
      );
    }
  }

  link() {
    return `${location.href.replace(/#.*$/, "")}#${toLink(this.field.example, this.state.scene)}`;
  }

  copyLink() {
    return this.guard(async () => {
      const link = this.link();
      history.replaceState(null, "", link);
      try {
        await navigator.clipboard.writeText(link);
        this.say("The link is in the clipboard, and in the address line.");
      } catch {
        this.say("The link is in the address line.");
      }
    });
  }

  /** How far the samples of the host of the screen are from the exact sums. */
  async check() {
    await this.guard(async () => {
      if (!this.picture.host.renderer) {
        this.say("What is shown are the exact sums.");
        return;
      }
      this.say("The exact picture is being made …");
      const { worst, share } = await this.compare();
      this.say(
        `The largest difference from the exact sums is ${worst} of 255; ${(100 * share).toFixed(2)} % differ by more than 2.`,
      );
    });
  }

  async compare() {
    const { data, statistics } = await this.exact();
    const { canvas, host } = this.picture;
    const size = [canvas.width, canvas.height];
    const { width, height, spacing } = this.field;
    const [sx, sy] = spacing;
    // A pixel a sample, at least.
    canvas.width = Math.ceil(width * Math.max(sx / sy, 1));
    canvas.height = Math.ceil(height * Math.max(sy / sx, 1));
    let worst = 0;
    let wrong = 0;
    try {
      host.renderer.render();
      const shown = host.renderer.readColors();
      if (shown.width !== width || shown.height !== height) {
        throw new Error("The relief is too large to be checked here.");
      }
      const factor = 2 ** statistics.exposure;
      for (let k = 0; k < data.length; k += 4) {
        let apart = 0;
        for (let c = 0; c < 3 && data[k + 3] !== 0; ++c) {
          apart = Math.max(apart, Math.abs(data[k + c] - toCode(factor * shown.data[k + c])));
        }
        worst = Math.max(worst, apart);
        wrong += apart > 2 ? 1 : 0;
      }
    } finally {
      [canvas.width, canvas.height] = size;
      this.picture.schedule();
    }
    return { worst, share: wrong / (data.length / 4) };
  }
}

//--------------------------------------------------------------------------------------------------
// Meanwhile; where it fails who needs it says so.
init().catch(() => {});
const examples = await (await fetch(new URL("examples/examples.json", import.meta.url))).json();
// A worker reads while the page is put together.
const reading = location.hash === "" ? readExample(examples[0]) : undefined;
const page = new Page(examples);
// For the console, and for tests.
globalThis.reliefPage = page;
await page.guard(() => page.openLink(reading));
// Where no example could be opened there is none, and a file may be.
if (page.field) {
  await page.picture.first;
}
page.firstPicture = performance.now(); // since it was opened
document.documentElement.dataset.ready = "true";

// For when there is no network; where that cannot be, the page goes on without.
navigator.serviceWorker?.register(new URL("offline.js", import.meta.url)).catch(() => {});
