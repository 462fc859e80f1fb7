// SPDX-License-Identifier: BSD-3-Clause
//
// A field, shaded: what has been found out is kept, so that each frame does what has changed only, and no
// more than it has time for. As ReliefFrames does it.
//
// Lights come in two classes. The first few are shown from the first frame on, coarse if there is no time for
// more. The rest, as an environment has them, are added one by one to sums of their own, the strongest first;
// while some are missing, the sums are scaled to the brightness of all.

import { coverGrid } from './color-textures.js';
import { Grid, makeGrid } from './grid.js';
import { illuminationKey, strength, sumOf } from './lights.js';
import { MOST_GATHERED, traceProgram } from './programs.js';

const BAND_SECONDS = 0.02; // longer draws make the browser believe that its page hangs
const FIRST_TEXELS = 2048;  // of the first band, which tells how long others take
const COARSEST = 16;
const MOST_FIRST_LIGHTS = 8;
const TEXELS_PER_PIXEL = 3;
const SUMS = ['diffuse', 'scatter', 'specular'];

const now = () => performance.now() / 1000;
export class Frames
{
  constructor(passes)
  {
    this.passes = passes;
    this.entries = new Map(); // lists of what is kept of a light, by key: lights may be alike
    this.stamp = 0;
    this.secondsPerTexel = 0;
    this.full = new Grid();  // all that can be seen
    this.shown = new Grid(); // what is shown of it
    this.firstSums = null;
    this.later = null;
    this.colors = null;
    this.colorTextures = {};
    this.gatheredFrom = '';
    this.composedFrom = '';
    this.version = 0; // changes with the colours
  }

  //----------------------------------------------------------------------------
  // Layers

  layer(grid, components)
  {
    return { grid, texture: this.passes.texture(grid.size[0], grid.size[1], components) };
  }

  drop(layer)
  {
    this.passes.release(layer?.texture);
  }

  newSums(grid, features)
  {
    return {
      grid, features: { ...features },
      textures: SUMS.map((name) =>
        (features[name] ? this.passes.texture(grid.size[0], grid.size[1], 4) : null)),
    };
  }

  dropSums(sums)
  {
    sums?.textures.forEach((texture) => this.passes.release(texture));
  }

  //----------------------------------------------------------------------------
  // Plan

  elapsed()
  {
    return now() - this.begin;
  }

  estimate(grid)
  {
    return grid.texels * this.secondsPerTexel;
  }

  // Finds what is kept for a light, or makes room for it.
  findEntry(key)
  {
    const alike = this.entries.get(key) ?? [];
    let entry = alike.find((one) => !one.used);
    if (!entry)
    {
      entry = { complete: null, pending: null, rows: 0, stamp: 0, used: false };
      this.entries.set(key, [...alike, entry]);
    }
    entry.used = true;
    return entry;
  }

  dropEntry(entry)
  {
    this.drop(entry.complete);
    this.drop(entry.pending);
  }

  // Sorts the lights into the two classes and finds what is kept of them.
  classify()
  {
    this.first = [];
    this.rest = [];
    this.entries.forEach((alike) => alike.forEach((entry) => { entry.used = false; }));
    let room = this.request.memory / (4 * Math.max(this.full.texels, 1));
    for (const light of this.scene.lights)
    {
      if (!light.shows || (!light.matte && !this.sums.specular))
      {
        continue;
      }
      const key = illuminationKey(this.field, this.scene, light);
      // What stands for a patch of the sky, or of a sun's disc, is one of many.
      const first = !light.matte || (light.one && room >= 1 && this.first.length < MOST_FIRST_LIGHTS);
      const kept = light.matte && room >= 1;
      room -= kept ? 1 : 0;
      (first ? this.first : this.rest).push({ light, key, entry: kept ? this.findEntry(key) : null });
    }
    for (const [key, alike] of this.entries)
    {
      alike.filter((entry) => !entry.used).forEach((entry) => this.dropEntry(entry));
      const used = alike.filter((entry) => entry.used);
      if (used.length > 0)
      {
        this.entries.set(key, used);
      }
      else
      {
        this.entries.delete(key);
      }
    }
  }

  //----------------------------------------------------------------------------
  // Tracing

  // Traces rows of a layer from `row` on until all are done or the time is up, at least one band. Returns the
  // row that comes next.
  traceRows(light, layer, row, seconds, quick = false)
  {
    const [columns, rows] = layer.grid.size;
    let next = row;
    let used = 0;
    do
    {
      const texels = this.secondsPerTexel > 0 ? BAND_SECONDS / this.secondsPerTexel : FIRST_TEXELS;
      const band = Math.max(Math.floor(texels / columns), 1);
      const end = Math.min(next + band, rows);
      const before = now();
      this.passes.trace(this.scene, light, layer, next, end, quick);
      this.passes.finish();
      const took = now() - before;
      if (!this.passes.compiled)
      {
        const measured = took / ((end - next) * columns);
        this.secondsPerTexel = this.secondsPerTexel > 0
          ? 0.5 * (this.secondsPerTexel + measured) : measured;
        this.longestDraw = Math.max(this.longestDraw, took);
      }
      used += took;
      next = end;
    } while (next < rows && used < seconds && !this.passes.gl.isContextLost());
    return next;
  }

  gridOf(coarseness)
  {
    const { part, mostSize, pixels } = this.request;
    return makeGrid(part, this.field.columns, this.field.rows, coarseness,
      Math.max(TEXELS_PER_PIXEL * pixels, 4096), mostSize);
  }

  // The finest grid over what can be seen that so many lights can be traced for in the time given, if any.
  affordableGrid(lights, seconds)
  {
    for (let coarseness = this.request.coarseness;; coarseness *= 2 ** 0.25)
    {
      const last = coarseness >= Math.max(COARSEST, this.request.coarseness);
      // Before anything is known the second coarsest is a good guess.
      const grid = this.gridOf(this.secondsPerTexel > 0 || last ? coarseness : COARSEST / 2);
      if (last || this.secondsPerTexel === 0 || lights * this.estimate(grid) <= seconds)
      {
        return grid;
      }
    }
  }

  // Whether a kept layer is as fine as what is wanted.
  serves(layer)
  {
    return layer !== null && (layer.grid.serves(this.full, this.field) ||
      (this.request.coarseness > 1 && layer.grid.reaches(this.full) && layer.grid.detail >= this.full.detail));
  }

  // Brings the lights whose illumination is kept as far as time allows, and chooses the grid to show.
  updateFirst()
  {
    const { seconds, moving } = this.request;
    let expected = 0;
    const missing = [];
    for (const one of this.first.filter(({ entry }) => entry))
    {
      const { entry } = one;
      if (this.serves(entry.complete))
      {
        ++this.reused;
        continue;
      }
      missing.push(one);
      entry.rows = entry.pending && entry.pending.grid.equals(this.full) ? entry.rows : 0;
      expected += this.estimate(this.full) * (1 - entry.rows / this.full.size[1]);
    }
    this.shown = this.full;
    const all = seconds === Infinity || (this.secondsPerTexel > 0 && expected <= seconds);
    if (!all && missing.length > 0)
    {
      this.traceCoarse(missing, moving ? seconds : seconds / 2);
    }
    for (const { light, entry } of missing)
    {
      const left = seconds - this.elapsed();
      if (!all && (moving || left <= 0))
      {
        break;
      }
      // While the whole program is compiled, what is coarse serves.
      if (seconds !== Infinity && entry.complete && !this.passes.isReady(traceProgram(this.scene, light, false)))
      {
        continue;
      }
      this.traced.add(light);
      if (entry.rows === 0)
      {
        this.drop(entry.pending);
        entry.pending = this.layer(this.full, 1);
      }
      entry.rows = this.traceRows(light, entry.pending, entry.rows, all ? Infinity : left);
      if (entry.rows === this.full.size[1])
      {
        this.drop(entry.complete);
        Object.assign(entry, { complete: entry.pending, pending: null, rows: 0, stamp: ++this.stamp });
      }
    }
    for (const { entry } of missing)
    {
      if (!this.serves(entry.complete) &&
        (this.shown === this.full || entry.complete.grid.detail < this.shown.detail))
      {
        this.shown = entry.complete.grid;
      }
    }
  }

  // Something to show first.
  traceCoarse(missing, seconds)
  {
    const coarse = this.affordableGrid(missing.length, seconds);
    for (const { light, entry } of missing)
    {
      if (entry.complete && entry.complete.grid.reaches(this.full) &&
        entry.complete.grid.detail >= coarse.detail / 2)
      {
        continue;
      }
      this.traced.add(light);
      this.drop(entry.complete);
      entry.complete = this.layer(coarse, 1);
      this.traceRows(light, entry.complete, 0, Infinity, true);
      entry.stamp = ++this.stamp;
    }
  }

  //----------------------------------------------------------------------------
  // Sums over the first lights

  gatherFirst()
  {
    const { scene } = this;
    const from = JSON.stringify([this.shown, this.sums, scene.specularFalloff, scene.scatterFalloff,
      this.first.map(({ light, entry }) =>
        [entry ? entry.stamp : 0, light.directional, light.vector, light.radiance]),
      this.first.length > 0 ? [scene.medium, this.field.version] : 0]);
    if (this.gatheredFrom === from)
    {
      return;
    }
    this.gatheredFrom = '';
    this.dropSums(this.firstSums);
    this.firstSums = null;
    if (SUMS.some((name) => this.sums[name]) && this.first.length > 0)
    {
      // Lights that give highlights only come last: they add to one of the sums.
      const lit = this.first.filter(({ entry }) => entry)
        .map(({ light, entry }) => ({ light, layer: entry.complete }));
      const mirrors = this.first.filter(({ entry }) => !entry).map(({ light }) => ({ light, layer: null }));
      const sums = this.newSums(this.shown, this.sums);
      this.firstSums = sums;
      if (lit.length === 0)
      {
        this.passes.clear(sums);
      }
      this.passes.gather(scene, lit, sums, false);
      const mirrored = {
        ...sums, features: { diffuse: false, scatter: false, specular: sums.features.specular },
        textures: [null, null, sums.textures[2]],
      };
      this.passes.gather(scene, mirrors, mirrored, true);
      sums.textures[2] = mirrored.textures[2];
    }
    this.gatheredFrom = from;
  }

  //----------------------------------------------------------------------------
  // Sums over the rest

  // What the later sums are to be multiplied by if they are over the lights at hand, up to a common factor of
  // their radiances; null if they are not.
  laterFactor()
  {
    const { later, scene } = this;
    if (!later || later.keys.length !== this.rest.length ||
      later.form !== JSON.stringify([this.sums, this.sums.specular && scene.specularFalloff,
        this.sums.scatter && scene.scatterFalloff]))
    {
      return null;
    }
    const total = (radiances) => radiances.reduce((sum, r) => sum.map((s, c) => s + r[c]), [0, 0, 0]);
    const before = total(later.radiances);
    const after = total(this.rest.map(({ light }) => light.radiance));
    const factor = before.map((b, c) => (b !== 0 ? after[c] / b : 1));
    const same = this.rest.every(({ light, key }, k) =>
    {
      const expected = later.radiances[k].map((r, c) => factor[c] * r);
      const difference = light.radiance.map((r, c) => r - expected[c]);
      return later.keys[k] === key && sumOf(difference) <= 1e-6 * (sumOf(expected) + 1e-30);
    });
    return same ? factor : null;
  }

  restartLater()
  {
    const { request, scene, sums } = this;
    let grid = this.shown;
    if (request.moving)
    {
      // A few lights, that shadows do not come from one side only.
      const left = Math.max(request.seconds - this.elapsed(), request.seconds / 4);
      const coarse = this.affordableGrid(Math.min(this.rest.length, 4), left);
      grid = coarse.detail < grid.detail ? coarse : grid;
    }
    this.dropSums(this.later?.sums);
    const order = this.rest.map((_, k) => k)
      .sort((a, b) => strength(this.rest[b].light) - strength(this.rest[a].light));
    this.later = {
      keys: this.rest.map(({ key }) => key),
      radiances: this.rest.map(({ light }) => light.radiance),
      order, added: 0, stamp: ++this.stamp,
      form: JSON.stringify([sums, sums.specular && scene.specularFalloff, sums.scatter && scene.scatterFalloff]),
      sums: this.newSums(grid, sums),
    };
    this.passes.clear(this.later.sums);
  }

  // How much of the strength of the later lights has been added.
  laterShare()
  {
    const { later } = this;
    let all = 0;
    let added = 0;
    later.order.forEach((index, k) =>
    {
      const one = strength(this.rest[index].light);
      all += one;
      added += k < later.added ? one : 0;
    });
    return later.added < later.order.length && added > 0 ? added / all : 1;
  }

  // Finds the illumination of one of the rest, in a layer that is kept or in one that is to be dropped.
  lightLater({ light, entry }, passing)
  {
    const { grid } = this.later.sums;
    const kept = entry && entry.complete;
    if (kept && kept.grid.reaches(grid) && kept.grid.detail >= grid.detail)
    {
      ++this.reused;
      return kept;
    }
    const layer = this.layer(grid, 1);
    this.traceRows(light, layer, 0, Infinity);
    this.traced.add(light);
    // What is kept is worth more than a passing view.
    if (entry && !this.request.moving)
    {
      this.drop(entry.complete);
      Object.assign(entry, { complete: layer, stamp: ++this.stamp });
    }
    else
    {
      passing.push(layer);
    }
    return layer;
  }

  // Adds as many of the other lights as time allows, at least one.
  updateLater()
  {
    this.laterScale = [1, 1, 1];
    if (this.rest.length === 0)
    {
      this.dropSums(this.later?.sums);
      this.later = null;
      return;
    }
    const factor = this.laterFactor();
    // While things move, what there is serves, however coarse it is.
    const fits = factor && (this.request.moving ? this.later.sums.grid.reaches(this.full)
      : this.later.sums.grid.serves(this.shown, this.field));
    if (fits)
    {
      this.laterScale = factor;
    }
    else
    {
      this.restartLater();
    }
    const { later } = this;
    const needsIllumination = this.sums.diffuse || this.sums.scatter;
    for (let inTime = true; later.added < later.keys.length && inTime;)
    {
      const lights = [];
      const passing = [];
      while (later.added + lights.length < later.keys.length && lights.length < MOST_GATHERED && inTime)
      {
        const index = later.order[later.added + lights.length];
        const layer = needsIllumination ? this.lightLater(this.rest[index], passing) : null;
        // With the radiance that it had when the sums were begun.
        lights.push({ light: { ...this.rest[index].light, radiance: later.radiances[index] }, layer });
        inTime = this.elapsed() < this.request.seconds;
      }
      this.passes.gather(this.scene, lights, later.sums, true);
      passing.forEach((layer) => this.drop(layer));
      later.added += lights.length;
      later.stamp = ++this.stamp;
    }
    const share = this.laterShare();
    this.laterScale = this.laterScale.map((s) => s / share);
  }

  //----------------------------------------------------------------------------
  // Colours

  // The pictures that show.
  shownTextures()
  {
    const { scene, sums } = this;
    const { base, diffuse, specular } = scene.textures;
    return {
      base: scene.specularCoefficient < 1 ? base : undefined,
      diffuse: sums.diffuse || sums.scatter ? diffuse : undefined,
      specular: sums.specular ? specular : undefined,
    };
  }

  updateTextures()
  {
    const { scene } = this;
    const shown = this.shownTextures();
    for (const name of ['base', 'diffuse', 'specular'])
    {
      const picture = shown[name];
      const from = picture && JSON.stringify([this.shown, scene[name]]);
      const kept = this.colorTextures[name];
      if (kept && (kept.picture !== picture || kept.from !== from || kept.field !== this.field))
      {
        this.drop(kept);
        delete this.colorTextures[name];
      }
      if (picture && !this.colorTextures[name])
      {
        const texture = this.passes.texture(this.shown.size[0], this.shown.size[1], 4);
        this.passes.load(texture, coverGrid(picture, scene[name], this.shown, this.field));
        this.colorTextures[name] = { texture, picture, from, field: this.field };
      }
    }
    return Object.fromEntries(
      Object.entries(this.colorTextures).map(([name, { texture }]) => [name, texture]));
  }

  composeColors()
  {
    const { scene } = this;
    const from = JSON.stringify([this.gatheredFrom, this.shown, this.later?.stamp, this.laterScale, scene.base,
      scene.diffuse, scene.specular, scene.specularCoefficient, scene.scatterCoefficient, this.field.version,
      this.request.textures]);
    if (this.composedFrom === from)
    {
      return;
    }
    this.composedFrom = '';
    const textures = this.updateTextures();
    if (!this.colors || !this.colors.grid.equals(this.shown))
    {
      this.drop(this.colors);
      this.colors = this.layer(this.shown, 4);
    }
    const later = this.later && this.later.sums;
    const none = { diffuse: false, scatter: false, specular: false };
    this.passes.compose(scene, this.firstSums, later, this.laterScale,
      this.firstSums || later ? this.sums : none, textures, this.colors);
    this.composedFrom = from;
    ++this.version;
  }

  judgeProgress()
  {
    let done = 0;
    for (const { entry } of this.first)
    {
      done += !entry || this.serves(entry.complete) ? 1 : entry.rows / this.full.size[1];
    }
    if (this.later && this.later.sums.grid.serves(this.full, this.field))
    {
      done += this.later.added;
    }
    const lights = this.first.length + this.rest.length;
    this.progress = lights > 0 ? done / lights : 1;
    this.converged = done === lights && this.request.coarseness === 1;
  }

  //----------------------------------------------------------------------------
  // Shades as much as there is time for. The request has the part of the field that is seen, pixels, the
  // largest texture, memory for illuminations in bytes, seconds, whether things move, and coarseness.
  update(field, scene, request)
  {
    this.begin = now();
    this.request = request;
    this.scene = scene;
    this.reused = 0;
    this.traced = new Set();
    this.longestDraw = 0;
    const sameField = this.field === field;
    this.field = field;
    const full = this.gridOf(request.coarseness);
    // A larger one of the same stride, as after zooming in a little, saves tracing anew.
    const keep = sameField && this.full.holds(full) &&
      Math.max(...this.full.size) <= request.mostSize && this.full.texels <= 2 * full.texels;
    this.full = keep ? this.full : full;
    this.sums = scene.sums;
    this.converged = false;
    try
    {
      this.classify();
      this.passes.prepare(scene, this.first.map(({ light }) => light), this.rest.map(({ light }) => light),
        this.shownTextures(), request.seconds !== Infinity);
      this.updateFirst();
      this.gatherFirst();
      this.updateLater();
      this.composeColors();
    }
    catch (error)
    {
      // Nobody knows which layers hold what they say.
      this.forget();
      throw error;
    }
    this.judgeProgress();
  }

  forget()
  {
    this.entries.forEach((alike) => alike.forEach((entry) => this.dropEntry(entry)));
    this.entries.clear();
    this.dropSums(this.firstSums);
    this.dropSums(this.later?.sums);
    this.firstSums = null;
    this.later = null;
    this.gatheredFrom = '';
    this.composedFrom = '';
  }
  dispose()
  {
    this.forget();
    this.drop(this.colors);
    Object.values(this.colorTextures).forEach((one) => this.drop(one));
    this.colors = null;
    this.colorTextures = {};
  }
}
