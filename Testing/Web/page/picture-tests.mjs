// SPDX-License-Identifier: BSD-3-Clause
//
// What is shown, and by whom.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { ball, figures, rainbow } from './figures.mjs';
import { exrOf, heights16, heights8 } from './files.mjs';
import {
  alertOf, centre, decode, distances, encode, finish, give, nativePicture, open, openHeights, pictureOf, settled, values,
} from './harness.mjs';

export const tests = {
  // Every type of figure of the thesis, by the controls; each picture is another one, and the last one is
  // reliefshade's, too. A sheet of all of them is for people.
  async Figures()
  {
    const page = await open({ query: '?host=wasm', width: 1000, height: 700 });
    page.setDefaultTimeout(20000);
    const owl = decode(fs.readFileSync(path.join(values.page, 'examples', 'owl.png')));
    const [width, height] = [Math.floor(owl.width / 4), Math.floor(owl.height / 4)];
    const small = Uint16Array.from({ length: width * height }, (_, k) =>
      owl.data[4 * owl.width * Math.floor(k / width) + 4 * (k % width)]);
    const size = 100;
    const grey = (data, columns, rows) => Buffer.from(encode({ data, width: columns, height: rows, channels: 1, depth: 16 }));
    const heights = { owl: grey(small, width, height), ball: grey(ball(size), size, size) };
    const stripe = (channels) => Buffer.from(encode({ data: Uint8Array.from({ length: channels * width * height }, (_, k) =>
      [255, 120, 40][(Math.floor((Math.floor(k / channels) % width) / 20) + (k % channels)) % 3]), width, height, channels, depth: 8 }));
    const textures = { base: stripe(3), diffuse: stripe(3), specular: stripe(3), mask: stripe(1) };
    const around = exrOf(rainbow.values, rainbow.size, ['B', 'G', 'R']);
    fs.writeFileSync(path.join(values.output, 'rainbow.exr'), around);

    const set = async (key, value) =>
    {
      const [label, title] = key.split(': ').reverse();
      const panel = title
        ? page.locator('fieldset').filter({ has: page.locator('legend', { hasText: new RegExp(`^${title}$`) }) })
        : page.locator('#panel');
      if (typeof value === 'boolean')
      {
        await panel.getByLabel(label, { exact: true }).setChecked(value);
      }
      else if (typeof value === 'number')
      {
        await panel.getByLabel(`${label}, number`, { exact: true }).fill(String(value));
        await page.keyboard.press('Tab');
      }
      else if (value.startsWith('#'))
      {
        await panel.getByLabel(label, { exact: true }).fill(value);
      }
      else
      {
        await panel.getByLabel(label, { exact: true }).selectOption({ label: value });
      }
    };
    const picture = async (role, name, buffer) =>
    {
      await give(page, () => page.click(`[data-drop="${role}"] button >> nth=0`), name, buffer);
    };
    const apply = async (panel) =>
    {
      for (const [label, value] of Object.entries(panel))
      {
        switch (label)
        {
          case 'kind':
            await page.getByLabel(value, { exact: true }).check();
            break;
          case 'place':
            await page.mouse.click(...(await centre(page)).at(...value));
            break;
          case 'file':
            await page.evaluate(() => globalThis.reliefPage.changeEnvironment({ image: 'file', file: 'missing' }));
            await picture('environment', value, around);
            break;
          case 'texture':
            await picture(value, `${value}.png`, textures[value]);
            break;
          case 'preset':
            await page.getByRole('button', { name: value, exact: true }).click();
            await page.waitForFunction(() => !document.body.hasAttribute('aria-busy'));
            break;
          case 'add':
            await page.getByRole('button', { name: 'Add', exact: true }).click();
            await apply(value);
            break;
          default:
            await set(label, value);
        }
      }
    };
    const compare = (a, b) => a.reduce((sum, code, k) => sum + Math.abs(code - b[k]), 0) / a.length;

    const rows = [];
    let opened = null;
    for (const [title, { heights: name = 'owl', panels }] of Object.entries(figures))
    {
      if (opened !== name)
      {
        fs.writeFileSync(path.join(values.output, `${name}.png`), heights[name]);
        await openHeights(page, `${name}.png`, heights[name]);
        opened = name;
      }
      const pictures = [];
      for (const panel of panels)
      {
        await page.click('#reset');
        await apply(panel);
        assert.equal(await alertOf(page), '', title);
        const made = await page.evaluate(async () =>
        {
          const { data, width: columns, height: lines } = await globalThis.reliefPage.exact();
          let text = '';
          for (let k = 0; k < data.length; k += 4096)
          {
            text += String.fromCharCode(...data.subarray(k, k + 4096));
          }
          return { columns, lines, text: btoa(text), scene: await globalThis.reliefPage.sceneText() };
        });
        const data = new Uint8Array(Buffer.from(made.text, 'base64'));
        const levels = new Set(data).size;
        assert.ok(levels > 20, `${title}: ${levels} codes are all that there is`);
        pictures.forEach((other) => assert.ok(compare(other.data, data) > 0.3, `${title}: two pictures are alike`));
        pictures.push({ data, width: made.columns, height: made.lines });
        // Files of scenes have no textures.
        if (panel === panels[panels.length - 1] && !panel.texture)
        {
          const scene = path.join(values.output, 'figure-scene.json');
          fs.writeFileSync(scene, made.scene);
          const expected = nativePicture(path.join(values.output, `${name}.png`), scene);
          const shown = { data, width: made.columns, height: made.lines, channels: 4 };
          const wrong = expected ? distances(shown, expected).filter((apart) => apart > 2).length : 0;
          assert.ok(wrong <= 1e-3 * data.length / 4, `${title}: ${wrong} samples are others than reliefshade's`);
        }
      }
      rows.push(pictures);
    }
    const gap = 4;
    const cell = [Math.max(width, size) + gap, Math.max(height, size) + gap];
    const across = 2 * 4; // two figures side by side
    const sheet = { width: across * cell[0], height: Math.ceil(rows.length / 2) * cell[1], channels: 4, depth: 8 };
    const pixels = new Uint8Array(4 * sheet.width * sheet.height).fill(255);
    rows.forEach((pictures, row) => pictures.forEach((one, column) =>
    {
      const x = ((row % 2) * 4 + column) * cell[0];
      const y = Math.floor(row / 2) * cell[1];
      for (let j = 0; j < one.height; ++j)
      {
        pixels.set(one.data.subarray(4 * one.width * j, 4 * one.width * (j + 1)), 4 * ((y + j) * sheet.width + x));
      }
    }));
    fs.writeFileSync(path.join(values.output, 'figures.png'), encode({ ...sheet, data: pixels }));
    console.log(`${rows.length} figures, ${rows.flat().length} pictures`);
    await finish(page);
  },

  // A picture comes soon: of few requests, coarse at first, and so while something moves. Times are for people.
  async First()
  {
    const size = 512;
    const data = Uint16Array.from({ length: size * size }, (_, k) =>
      30000 + 15000 * (Math.sin((k % size) / 31) + Math.cos(k / size / 23)));
    const png = Buffer.from(encode({ data, width: size, height: size, channels: 1, depth: 16 }));
    const page = await open({ query: '', png, init: () =>
    {
      // What is drawn: its width, and when.
      globalThis.drawn = [];
      const draw = CanvasRenderingContext2D.prototype.drawImage;
      CanvasRenderingContext2D.prototype.drawImage = function(...values)
      {
        globalThis.drawn.push([values[0].width, performance.now()]);
        return draw.apply(this, values);
      };
    } });
    const drawn = () => page.evaluate(() => globalThis.drawn.splice(0));
    assert.deepEqual([...new Set(page.asked)].sort(), ['examples/examples.json', 'examples/small.png', 'files.worker.js',
      'index.html', 'main.js', 'reliefshading.wasm', 'style.css', 'worker.js']);
    // One for each worker: up to four that shade, and one that reads, which another one follows.
    assert.ok(page.asked.length <= 12, page.asked.join(' '));
    assert.equal(page.asked.filter((name) => name === 'reliefshading.wasm').length, 1);
    await settled(page);
    const opened = await drawn();
    const whole = opened.find(([width]) => width === size);
    assert.ok(opened[0][0] < size && whole, JSON.stringify(opened));
    console.log(`the first picture after ${opened[0][1].toFixed()} ms, at full detail ${(whole[1] - opened[0][1]).toFixed()} ms later`);
    // The same while the light is dragged.
    const box = await centre(page);
    await page.mouse.move(...box.at(0.3, 0.3));
    await page.mouse.down();
    const begin = Date.now();
    for (let k = 0; k < 60; ++k)
    {
      await page.mouse.move(...box.at(0.3 + k / 200, 0.4));
      await page.waitForTimeout(16);
    }
    await page.waitForFunction(() => globalThis.drawn.length > 0);
    const moved = await drawn();
    const seconds = (Date.now() - begin) / 1000;
    assert.ok(moved[0][0] < size, `${moved[0][0]} samples across while the light is dragged`);
    const end = await page.evaluate(() => performance.now());
    await page.mouse.up();
    await settled(page);
    const last = (await drawn()).find(([width]) => width === size);
    assert.ok(last, 'there is no full detail in the end');
    console.log(`${(moved.length / seconds).toFixed(1)} pictures a second while dragging, at full detail ${(last[1] - end).toFixed()} ms after`);
    await finish(page);
  },

  // Workers draw first, and then the graphics processor, where there is one; the picture stays meanwhile.
  async Hosts()
  {
    const page = await open({ query: '', init: () =>
    {
      const get = WebGL2RenderingContext.prototype.getParameter;
      WebGL2RenderingContext.prototype.getParameter = function(name)
      {
        return name === 0x9246 || name === this.RENDERER ? 'a graphics card' : get.call(this, name);
      };
      // The canvas whenever it is another one: its host, and whether that has drawn.
      globalThis.canvases = [];
      new MutationObserver(() =>
      {
        const picture = globalThis.reliefPage?.picture;
        const canvas = document.querySelector('#canvas');
        if (picture && canvas && globalThis.canvases.at(-1)?.canvas !== canvas)
        {
          globalThis.canvases.push({ canvas, host: picture.host.name, frames: picture.frames });
        }
      }).observe(document, { childList: true, subtree: true });
    } });
    await settled(page);
    assert.equal(await page.evaluate(() => document.documentElement.dataset.host), 'WebGL 2');
    const canvases = await page.evaluate(() => globalThis.canvases.map(({ host, frames }) => ({ host, frames })));
    assert.deepEqual(canvases.at(-1), { host: 'WebGL 2', frames: 2 });
    const { share } = await page.evaluate(() => globalThis.reliefPage.compare());
    assert.ok(share <= 1e-3, `${share} of the samples differ`);
    assert.equal(await alertOf(page), '');
    await finish(page);
  },

  async Context()
  {
    const page = await open();
    await openHeights(page, 'hills.png', heights8);
    const before = await pictureOf(page);
    await page.evaluate(() =>
    {
      globalThis.lose = globalThis.reliefPage.picture.host.renderer.gl.getExtension('WEBGL_lose_context');
      globalThis.lose.loseContext();
    });
    await page.waitForFunction(() => !document.querySelector('#alert').hidden);
    assert.match(await alertOf(page), /lost/);
    await page.evaluate(() => globalThis.lose.restoreContext());
    await page.waitForFunction(() => document.querySelector('#alert').hidden);
    assert.equal(await pictureOf(page), before);
    // Where it does not, the processor goes on.
    await page.evaluate(() => globalThis.lose.loseContext());
    await page.waitForFunction(() => document.documentElement.dataset.host === 'WebAssembly');
    assert.match(await alertOf(page), /has not come back/);
    const other = await pictureOf(page);
    await page.focus('#frame');
    await page.keyboard.press('Shift+ArrowRight');
    assert.notEqual(await pictureOf(page), other);
    page.complaints = page.complaints.filter((text) => !/CONTEXT_LOST|context lost/i.test(text));
    await finish(page);
  },

  // Without WebGL 2.
  async Processor()
  {
    const page = await open({ query: '?host=wasm' });
    assert.equal(await page.evaluate(() => document.documentElement.dataset.host), 'WebAssembly');
    await openHeights(page, 'hills.png', heights16);
    const before = await pictureOf(page);
    await page.focus('#frame');
    await page.keyboard.press('Shift+ArrowRight');
    await page.waitForTimeout(300);
    assert.notEqual(await pictureOf(page), before);
    // A picture that takes long is given up for one that moves.
    const shader = await page.evaluateHandle(() => globalThis.reliefPage.picture.host.shader);
    await page.evaluate(() => globalThis.reliefPage.setEnvironment({ image: 'whiteDome', numberOfSamples: 16384 }));
    await page.waitForFunction(() => performance.now() - (globalThis.reliefPage.picture.host.since ?? Infinity) > 400);
    await page.keyboard.press('ArrowRight');
    assert.ok(await page.evaluate((old) => globalThis.reliefPage.picture.host.shader !== old, shader));
    await page.evaluate(() => globalThis.reliefPage.setEnvironment(null));
    assert.notEqual(await pictureOf(page), before);
    assert.equal(await alertOf(page), '');
    await finish(page);
  },

  // How it looks, and how soon; the pictures are for people.
  async Views()
  {
    const sizes = { phone: [390, 844], tablet: [820, 1180], desktop: [1440, 900] };
    for (const [name, [width, height]] of Object.entries(sizes))
    {
      const begin = Date.now();
      // Without a graphics processor the page itself chooses the other host.
      const query = name === 'phone' ? '?host=webgl' : '';
      const page = await open({ width, height, query, small: false, colorScheme: name === 'tablet' ? 'dark' : 'light' });
      console.log(`${name}: first picture after ${(await page.evaluate(() => globalThis.reliefPage.firstPicture)).toFixed(0)} ms`);
      const [wide, frame] = await page.evaluate(() =>
        [document.documentElement.scrollWidth, document.querySelector('#frame').getBoundingClientRect().toJSON()]);
      assert.ok(wide <= width, `${name}: ${wide} pixels wide`);
      assert.ok(frame.width >= 0.5 * Math.min(width, 400) && frame.bottom <= height, JSON.stringify(frame));
      await settled(page);
      console.log(`${name}: at its best after ${Date.now() - begin} ms, ` +
        await page.evaluate(() => document.documentElement.dataset.host));
      await page.screenshot({ path: path.join(values.output, `${name}.png`) });
      if (name === 'phone')
      {
        // While the light is dragged.
        const box = await centre(page);
        const start = await page.evaluate(() => [performance.now(), globalThis.reliefPage.picture.frames]);
        await page.mouse.move(...box.at(0.2, 0.2));
        await page.mouse.down();
        for (let k = 0; k < 40; ++k)
        {
          await page.mouse.move(...box.at(0.2 + k / 80, 0.3));
          await page.waitForTimeout(16);
        }
        const end = await page.evaluate(() => [performance.now(), globalThis.reliefPage.picture.frames]);
        await page.mouse.up();
        console.log(`${((1000 * (end[1] - start[1])) / (end[0] - start[0])).toFixed(1)} pictures a second while dragging`);
      }
      await finish(page);
    }
  },
};
