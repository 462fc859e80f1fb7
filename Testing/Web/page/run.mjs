// SPDX-License-Identifier: BSD-3-Clause
//
// Tests of the page of Examples/Web in a headless browser.
//
//     node run.mjs TEST --page FOLDER --browser FOLDER --chromium FILE --libraries FOLDER --output FOLDER
//       [--reliefshade FILE]

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';

import { launch, serve } from '../webgl/browser.mjs';
import { ball, figures, rainbow } from './figures.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: Object.fromEntries(['page', 'browser', 'chromium', 'libraries', 'output', 'reliefshade']
    .map((name) => [name, { type: 'string' }])),
});
const { encode, decode } = await import(
  pathToFileURL(path.join(values.libraries, 'node_modules', 'fast-png', 'lib', 'index.js')));
fs.mkdirSync(values.output, { recursive: true });

const COLUMNS = 96;
const ROWS = 80;
const PATIENCE = 120000; // milliseconds, of machines that have other work

//--------------------------------------------------------------------------------------------------
// Files to be opened.

function hills(most)
{
  return Uint16Array.from({ length: COLUMNS * ROWS }, (_, k) =>
  {
    const [i, j] = [k % COLUMNS, Math.floor(k / COLUMNS)];
    return most * (0.5 + 0.3 * Math.sin(i / 9 + Math.cos(j / 13)) + 0.2 * Math.sin(i / 5 - j / 7));
  });
}

const png = (data, channels, depth) => Buffer.from(encode({ data, width: COLUMNS, height: ROWS, channels, depth }));
const heights16 = png(hills(60000), 1, 16);
const heights8 = png(Uint8Array.from(hills(250)), 1, 8);
const stripes = png(Uint8Array.from({ length: 3 * COLUMNS * ROWS }, (_, k) => (k % 3 === 0 || k % 90 < 45 ? 255 : 30)), 3, 8);
const half = png(Uint8Array.from({ length: COLUMNS * ROWS }, (_, k) => (k % COLUMNS < COLUMNS / 2 ? 255 : 0)), 1, 8);

// A TIFF of one strip of floats, little-endian, 2 units a sample.
function floatTiff()
{
  const data = Float32Array.from(hills(60), (h) => h / 2);
  const doubles = Buffer.alloc(72);
  [2, 2, 0].forEach((value, k) => doubles.writeDoubleLE(value, 8 * k));
  [0, 0, 0, 1000, 5000, 0].forEach((value, k) => doubles.writeDoubleLE(value, 24 + 8 * k));
  const entries = [[256, 3, 1, COLUMNS], [257, 3, 1, ROWS], [258, 3, 1, 32], [259, 3, 1, 1], [262, 3, 1, 1],
    [273, 4, 1, 0], [277, 3, 1, 1], [278, 3, 1, ROWS], [279, 4, 1, data.byteLength], [339, 3, 1, 3],
    [33550, 12, 3, 0], [33922, 12, 6, 0]];
  const begin = 8 + 2 + 12 * entries.length + 4;
  entries[5][3] = begin + 72;
  entries[10][3] = begin;
  entries[11][3] = begin + 24;
  const head = Buffer.alloc(begin);
  head.write('II', 0);
  head.writeUInt16LE(42, 2);
  head.writeUInt32LE(8, 4);
  head.writeUInt16LE(entries.length, 8);
  entries.forEach(([tag, type, count, value], k) =>
  {
    const at = 10 + 12 * k;
    head.writeUInt16LE(tag, at);
    head.writeUInt16LE(type, at + 2);
    head.writeUInt32LE(count, at + 4);
    head.writeUInt32LE(value, at + 8);
  });
  return Buffer.concat([head, doubles, Buffer.from(data.buffer)]);
}

// A panorama, floats of red, green and blue from the top: a bright place in the east, a dim one in the south-west.
const AROUND = [32, 16];
const panorama = Float32Array.from({ length: 3 * AROUND[0] * AROUND[1] }, (_, k) =>
{
  const [i, j, c] = [Math.floor(k / 3) % AROUND[0], Math.floor(k / 3 / AROUND[0]), k % 3];
  return 0.1 + (i < 4 && j < 7 ? [9, 5, 2][c] : 0) + (i > 18 && i < 23 && j > 2 && j < 8 ? [0.5, 1, 2][c] : 0);
});

// An OpenEXR file of scanlines that are not compressed, its channels as it has them, in the order of their names.
function exrOf(values, [columns, rows], names)
{
  const text = (string) => Buffer.from(`${string}\0`, 'latin1');
  const ints = (...numbers) => Buffer.from(Int32Array.from(numbers).buffer);
  const attribute = (name, type, ...parts) =>
  {
    const value = Buffer.concat(parts);
    return Buffer.concat([text(name), text(type), ints(value.length), value]);
  };
  const channels = names.flatMap((name) => [text(name), ints(2, 0, 1, 1)]);
  const box = ints(0, 0, columns - 1, rows - 1);
  const head = Buffer.concat([Buffer.from([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]),
    attribute('channels', 'chlist', ...channels, Buffer.from([0])), attribute('compression', 'compression', Buffer.from([0])),
    attribute('dataWindow', 'box2i', box), attribute('displayWindow', 'box2i', box),
    attribute('lineOrder', 'lineOrder', Buffer.from([0])),
    attribute('pixelAspectRatio', 'float', Buffer.from(Float32Array.of(1).buffer)),
    attribute('screenWindowCenter', 'v2f', Buffer.from(Float32Array.of(0, 0).buffer)),
    attribute('screenWindowWidth', 'float', Buffer.from(Float32Array.of(1).buffer)), Buffer.from([0])]);
  const size = names.length * columns * 4;
  const offsets = Buffer.alloc(8 * rows);
  const lines = [];
  for (let j = 0; j < rows; ++j)
  {
    offsets.writeBigUInt64LE(BigInt(head.length + 8 * rows + j * (size + 8)), 8 * j);
    // Blue comes before green and red.
    const planes = names.map((_, c) => Buffer.from(Float32Array.from({ length: columns }, (__, i) =>
      values[names.length * (j * columns + i) + names.length - 1 - c]).buffer));
    lines.push(ints(j, size), ...planes);
  }
  return Buffer.concat([head, offsets, ...lines]);
}

// A Radiance picture without repetitions, of half the values, which its exposure makes up for.
function radianceOf(values, [columns, rows])
{
  const head = Buffer.from(`#?RADIANCE\nEXPOSURE=0.5\nFORMAT=32-bit_rle_rgbe\n\n-Y ${rows} +X ${columns}\n`, 'latin1');
  const lines = [];
  for (let j = 0; j < rows; ++j)
  {
    const planes = [0, 1, 2, 3].map(() => Buffer.alloc(columns));
    for (let i = 0; i < columns; ++i)
    {
      const color = [0, 1, 2].map((c) => values[3 * (j * columns + i) + c] / 2);
      const exponent = Math.floor(Math.log2(Math.max(...color))) + 1;
      color.forEach((value, c) => { planes[c][i] = Math.floor((value / 2 ** exponent) * 256); });
      planes[3][i] = exponent + 128;
    }
    lines.push(Buffer.from([2, 2, columns >> 8, columns & 255]),
      ...planes.flatMap((plane) => [Buffer.from([columns]), plane]));
  }
  return Buffer.concat([head, ...lines]);
}

//--------------------------------------------------------------------------------------------------
// The page, with no other address to be reached.

const browser = await launch(values.browser, values.chromium);
const server = await serve({ page: values.page });
const address = `${server.url}page/index.html`;

async function open({ width = 620, height = 420, query = '?host=webgl', hash = '', ...rest } = {})
{
  const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true, ...rest });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  page.complaints = [];
  page.on('console', (message) =>
  {
    const text = message.text();
    if (['error', 'warning'].includes(message.type()) && !text.includes('GPU stall due to ReadPixels'))
    {
      page.complaints.push(text);
    }
  });
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  await context.route((url) => url.origin !== new URL(server.url).origin && url.protocol.startsWith('http'), (route) =>
  {
    page.complaints.push(`asks for ${route.request().url()}`);
    return route.abort();
  });
  await page.goto(`${address}${query}${hash}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: PATIENCE });
  return page;
}

const settled = (page) => page.evaluate(() => globalThis.reliefPage.picture.settled());
const sceneOf = (page) => page.evaluate(() => globalThis.reliefPage.state.scene);
const alertOf = (page) => page.evaluate(() => document.querySelector('#alert:not([hidden]) span')?.textContent ?? '');

// A number that another picture hardly has.
async function pictureOf(page)
{
  await settled(page);
  return page.evaluate(() =>
  {
    const { canvas } = globalThis.reliefPage.picture;
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
    const { renderer } = globalThis.reliefPage.picture.host;
    if (renderer)
    {
      return renderer.readPixels().data.reduce((sum, c, k) => (sum * 31 + c * (k % 97)) % 1000000007, 7);
    }
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, c, k) => (sum * 31 + c * (k % 97)) % 1000000007, 7);
  });
}

// By the page's own dialog of files.
async function give(page, click, name, buffer)
{
  const chosen = page.waitForEvent('filechooser');
  await click();
  await (await chosen).setFiles({ name, mimeType: 'application/octet-stream', buffer });
  await page.waitForTimeout(50);
  await page.waitForFunction(() => !document.body.hasAttribute('aria-busy'));
}

const openHeights = (page, name, buffer) => give(page, () => page.click('#open'), name, buffer);

async function downloadBy(page, button)
{
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(`text="${button}"`)]);
  const file = path.join(values.output, download.suggestedFilename());
  await download.saveAs(file);
  return file;
}

// Where the relief is: at(u, v) is a place on it, as a share from the left and from the top.
const centre = async (page) =>
{
  const box = await page.locator('#frame').boundingBox();
  const [[left, top], [width, height]] = await page.evaluate(() =>
  {
    const { view } = globalThis.reliefPage;
    return [view.toPixels([0, 0]), view.size];
  });
  const [x, y] = [box.x + left, box.y + top];
  return { x, y, width, height, at: (u, v) => [x + u * width, y + v * height] };
};

const viewOf = (page) => page.evaluate(() =>
{
  const { zoom, center } = globalThis.reliefPage.view;
  return { zoom, center: [...center] };
});

const near = (a, b, most) => a.every((c, k) => Math.abs(c - b[k]) <= most);

// Whether what the page has saved is what reliefshade makes of heights and scene.
function compareWithNative(field, scene, saved)
{
  if (!values.reliefshade)
  {
    console.log('reliefshade is not there to be compared with');
    return;
  }
  const native = path.join(values.output, `native-${positionals[0]}.png`);
  const result = spawnSync(values.reliefshade, [field, native, '--scene', scene], { encoding: 'utf8' });
  assert.equal(result.status, 0, result.stderr);
  const made = decode(fs.readFileSync(native));
  assert.deepEqual([made.width, made.height, made.depth], [COLUMNS, ROWS, 8]);
  let worst = 0;
  for (let k = 0; k < COLUMNS * ROWS; ++k)
  {
    for (let c = 0; c < 3; ++c)
    {
      const of = (image) => image.data[image.channels * k + Math.min(c, image.channels - 1)];
      worst = Math.max(worst, Math.abs(of(saved) - of(made)));
    }
  }
  console.log(`the saved picture and that of reliefshade --scene differ by ${worst} of 255 at most`);
  assert.ok(worst <= 2, `${worst} of 255`);
}

async function finish(page)
{
  assert.deepEqual(page.complaints, [], 'the page complains');
  await page.context().close();
}

//--------------------------------------------------------------------------------------------------

const tests = {
  // Light by mouse, finger and keys.
  async Light()
  {
    const page = await open({ hasTouch: true });
    await openHeights(page, 'hills.png', heights16);
    let before = await pictureOf(page);
    const changed = async (what) =>
    {
      const after = await pictureOf(page);
      assert.notEqual(after, before, `${what} does not change the picture`);
      before = after;
    };
    // A sun to begin with: half way to the circle in the east.
    let box = await centre(page);
    const reach = Math.min(box.width, box.height) / 2;
    await page.mouse.move(...box.at(0.9, 0.9));
    await page.mouse.down();
    for (let k = 1; k <= 5; ++k)
    {
      await page.mouse.move(box.x + box.width / 2 + (reach / 2) * (k / 5), box.y + box.height / 2);
    }
    await page.mouse.up();
    let [light] = (await sceneOf(page)).lights;
    assert.ok(Math.abs(light.azimuth - 90) < 1 && Math.abs(light.altitude - 45) < 1, JSON.stringify(light));
    await changed('the mouse');
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('Shift+ArrowUp');
    assert.ok((await sceneOf(page)).lights[0].azimuth < 89);
    await changed('the keyboard');
    await page.keyboard.press('PageDown');
    await changed('page down');

    // A lamp comes from the same direction, and then to the finger.
    await page.check('text=Point >> input');
    [light] = (await sceneOf(page)).lights;
    assert.equal(light.kind, 'point');
    await changed('another kind');
    box = await centre(page); // which scrolling has moved
    await page.touchscreen.tap(...box.at(0.25, 0.75));
    [light] = (await sceneOf(page)).lights;
    assert.ok(Math.abs(light.position[0] - (0.25 * COLUMNS - 0.5)) < 1, JSON.stringify(light));
    assert.ok(Math.abs(light.position[1] - (0.25 * ROWS - 0.5)) < 1, JSON.stringify(light));
    await changed('a finger');
    // Another light, and the first one again by its dot.
    await page.click('text="Add"');
    assert.equal((await sceneOf(page)).lights.length, 2);
    await changed('another light');
    await page.mouse.click(...(await centre(page)).at(0.25, 0.75));
    assert.equal(await page.evaluate(() => globalThis.reliefPage.state.selected), 0);
    await page.click('text="Remove"');
    assert.equal((await sceneOf(page)).lights.length, 1);
    // Everything that takes input can be reached by tab, and is named.
    const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, select, [tabindex]')]
      .filter((one) => one.id !== 'file' && one.tabIndex >= 0)
      .filter((one) => !(one.getAttribute('aria-label') || one.labels?.length || one.textContent.trim()))
      .map((one) => one.outerHTML));
    assert.deepEqual(nameless, []);
    await page.focus('#frame');
    const reached = new Set();
    for (let k = 0; k < 12; ++k)
    {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() =>
      {
        const one = document.activeElement;
        return getComputedStyle(one).outlineStyle === 'none' ? 'no outline' : one.outerHTML;
      }));
    }
    assert.ok(reached.size === 12 && !reached.has('no outline'), [...reached].join(' '));
    await finish(page);
  },

  // The picture enlarged and moved, by mouse, fingers, keys and buttons; the light goes its own ways.
  async View()
  {
    for (const query of ['?host=webgl', '?host=wasm'])
    {
      const page = await open({ hasTouch: true, query });
      await openHeights(page, 'hills.png', heights16);
      await page.check('text=Point >> input');
      await pictureOf(page);
      const scene = async () => JSON.stringify(await sceneOf(page));
      const lightAt = async () =>
      {
        const [x, y] = (await sceneOf(page)).lights[0].position;
        return [(x + 0.5) / COLUMNS, 1 - (y + 0.5) / ROWS];
      };
      const drag = async (from, to, button = 'left') =>
      {
        await page.mouse.move(...from);
        await page.mouse.down({ button });
        for (let k = 1; k <= 4; ++k)
        {
          await page.mouse.move(...from.map((c, axis) => c + ((to[axis] - c) * k) / 4));
        }
        await page.mouse.up({ button });
      };
      await page.mouse.click(...(await centre(page)).at(0.5, 0.5));
      await page.waitForTimeout(400); // or it were half of a double click
      let before = await scene();
      const unmoved = async (what) => assert.equal(await scene(), before, `${what} changes the scene`);
      const share = (point) => page.evaluate(([x, y]) =>
      {
        const { left, top } = document.querySelector('#frame').getBoundingClientRect();
        return globalThis.reliefPage.view.toShare([x - left, y - top]);
      }, point);

      // The wheel enlarges about the pointer, once the relief fills the room.
      const pointer = (await centre(page)).at(0.3, 0.4);
      await page.mouse.move(...pointer);
      const turn = async (times, least) =>
      {
        for (let k = 0; k < times; ++k)
        {
          await page.mouse.wheel(0, -120);
        }
        await page.waitForFunction((zoom) => globalThis.reliefPage.view.zoom > zoom, least);
      };
      await turn(6, 4);
      const place = await share(pointer);
      await turn(2, 6);
      assert.ok(near(await share(pointer), place, 1e-3), 'the place under the pointer has gone');
      await unmoved('the wheel');
      // Samples are shown where they are.
      await settled(page);
      const worst = await page.evaluate(async () =>
      {
        const { picture, view, field } = globalThis.reliefPage;
        const { data } = await globalThis.reliefPage.exact();
        const { canvas } = picture;
        const shown = picture.host.renderer?.readPixels().data ??
          canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
        let most = 0;
        let count = 0;
        for (let j = 0; j < field.height; ++j)
        {
          for (let i = 0; i < field.width; ++i)
          {
            const at = view.toPixels([(i + 0.5) / field.width, (j + 0.5) / field.height])
              .map((c, k) => Math.floor((c * [canvas.width, canvas.height][k]) / view.room[k]));
            if (at[0] > 1 && at[1] > 1 && at[0] < canvas.width - 2 && at[1] < canvas.height - 2)
            {
              const k = 4 * (at[1] * canvas.width + at[0]);
              most = Math.max(most, Math.abs(shown[k] - data[4 * (j * field.width + i)]));
              ++count;
            }
          }
        }
        return count > 50 ? most : `${count} samples are seen`;
      });
      assert.ok(worst <= 12, `${query}: what is enlarged is off by ${worst} of 255`);

      // Dragging beside the dot moves the picture, and so do the middle button and the space bar, wherever they are.
      const frame = await page.locator('#frame').boundingBox();
      const middle = [frame.x + frame.width / 2, frame.y + frame.height / 2];
      const moves = async (what, body, by) =>
      {
        const place = await share(middle);
        await body();
        assert.ok(near(await share(middle.map((c, k) => c + by[k])), place, 1e-3), `${what} does not move the picture`);
        await unmoved(what);
      };
      await moves('dragging', () => drag(middle, [middle[0] + 40, middle[1] - 30]), [40, -30]);
      await moves('the middle button', () => drag(middle, [middle[0] - 20, middle[1] + 30], 'middle'), [-20, 30]);
      await page.focus('#frame');
      await page.keyboard.down(' ');
      await moves('the space bar', () => drag(middle, [middle[0] + 25, middle[1] + 15]), [25, 15]);
      await page.keyboard.up(' ');

      // A dot is dragged at any size.
      await page.evaluate(() =>
      {
        const { view } = globalThis.reliefPage;
        view.goTo(view.zoom, [0.5, 0.5]);
        view.onChange();
      });
      const target = [middle[0] + 60, middle[1] + 50];
      const view = await viewOf(page);
      const goal = await share(target);
      await drag((await centre(page)).at(...(await lightAt())), target);
      assert.ok(near(await lightAt(), goal, 0.01), `the light is at ${await lightAt()}, not at ${goal}`);
      assert.deepEqual(await viewOf(page), view);
      before = await scene();
      // Unless one thinks better of it.
      await page.mouse.move(...target);
      await page.mouse.down();
      await page.mouse.move(target[0] - 30, target[1] - 30, { steps: 3 });
      assert.notEqual(await scene(), before);
      await page.keyboard.press('Escape');
      await page.mouse.up();
      await unmoved('what was given up');

      // Keys and buttons.
      await page.keyboard.press('+');
      assert.ok((await viewOf(page)).zoom > view.zoom);
      const { center } = await viewOf(page);
      await page.keyboard.press('Control+ArrowRight');
      assert.ok((await viewOf(page)).center[0] > center[0]);
      await page.keyboard.press('-');
      await page.keyboard.press('0');
      assert.deepEqual(await viewOf(page), { zoom: 1, center: [0.5, 0.5] });
      assert.ok(await page.isDisabled('#smaller') && await page.isDisabled('#fit'));
      await page.getByLabel('Larger').click();
      assert.equal((await viewOf(page)).zoom, 1.5);
      assert.match(await page.textContent('#readout'), /zoom 150 %/);
      await page.getByLabel('The whole relief', { exact: true }).click();
      assert.equal((await viewOf(page)).zoom, 1);
      await unmoved('a key');

      // Two fingers.
      const session = await page.context().newCDPSession(page);
      const touch = (type, ...points) => session.send('Input.dispatchTouchEvent',
        { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
      const [a, b] = [[middle[0] - 30, middle[1]], [middle[0] + 30, middle[1]]];
      await touch('touchStart', a);
      await touch('touchStart', a, b);
      for (let k = 1; k <= 6; ++k)
      {
        await touch('touchMove', [a[0] - 10 * k, a[1]], [b[0] + 10 * k, b[1]]);
      }
      await touch('touchEnd');
      await page.waitForFunction(() => globalThis.reliefPage.view.zoom > 2.5);
      assert.ok(Math.abs((await viewOf(page)).zoom - 3) < 0.1, 'the fingers are three times as far apart');
      await unmoved('pinching');
      // A tap brings the light; a second one right after it takes that back and shows the whole.
      const taps = (times, point) => Promise.all(Array.from({ length: times }, () =>
        [touch('touchStart', point), touch('touchEnd')]).flat());
      await taps(1, a);
      assert.ok(near(await lightAt(), await share(a), 0.01));
      before = await scene();
      await page.waitForTimeout(400);
      await taps(2, b);
      assert.equal((await viewOf(page)).zoom, 1);
      await unmoved('a double tap');
      await page.evaluate(() => globalThis.reliefPage.view.zoomBy(4));
      await page.mouse.dblclick(middle[0] + 50, middle[1] + 40);
      assert.equal((await viewOf(page)).zoom, 1);
      await unmoved('a double click');
      // Shift and the wheel raise the lamp.
      await page.keyboard.down('Shift');
      await page.mouse.wheel(0, -120);
      await page.keyboard.up('Shift');
      await page.waitForFunction((old) => JSON.stringify(globalThis.reliefPage.state.scene) !== old, before);
      assert.equal((await viewOf(page)).zoom, 1);
      await finish(page);
    }
  },

  // Each slider, number, list, colour and box changes the scene, and can be taken back.
  async Controls()
  {
    const page = await open();
    await openHeights(page, 'hills.png', heights16);
    await page.check('text=Point >> input');
    await page.check('text=Light from all around >> input');
    await page.getByLabel('Image', { exact: true }).selectOption('clearSky');
    await page.check('text="Floor" >> input');
    const tryAll = () => page.evaluate(() =>
    {
      const { reliefPage } = globalThis;
      const failed = [];
      const label = (one) => one.getAttribute('aria-label') ?? one.labels?.[0]?.textContent;
      const scene = () => JSON.stringify(reliefPage.state.scene);
      const attempt = (one, change) =>
      {
        const before = scene();
        change();
        one.dispatchEvent(new Event('input', { bubbles: true }));
        one.dispatchEvent(new Event('change', { bubbles: true }));
        const after = scene();
        reliefPage.history.undo();
        if (after === before || scene() !== before)
        {
          failed.push(`${label(one)} (${one.type}): ${after === before ? 'nothing changes' : 'undo is not exact'}`);
        }
      };
      const shown = [...document.querySelectorAll('#panel input, #panel select')]
        .filter((one) => one.offsetParent !== null && !one.disabled);
      for (const one of shown)
      {
        if (one.type === 'range')
        {
          attempt(one, () => { one.value = Number(one.value) > 500 ? 300 : 700; });
        }
        else if (one.type === 'number')
        {
          attempt(one, () => { one.value = Number(one.value) === 0.5 ? 0.25 : one.step === '1' ? 3 : 0.5; });
        }
        else if (one.type === 'color')
        {
          attempt(one, () => { one.value = '#123456'; });
        }
        else if (one.type === 'checkbox' && label(one) !== 'Drag turns the environment')
        {
          attempt(one, () => { one.checked = !one.checked; });
        }
        else if (one.tagName === 'SELECT' && one.options.length > 1 && label(one) !== 'Image')
        {
          attempt(one, () => { one.selectedIndex = one.selectedIndex === 0 ? 1 : 0; });
        }
      }
      return { failed, count: shown.length };
    });
    // A sun has other controls than a lamp.
    const lamp = await tryAll();
    await page.check('text=Sun >> input');
    const sun = await tryAll();
    assert.deepEqual([...lamp.failed, ...sun.failed], []);
    assert.ok(lamp.count > 50 && sun.count > lamp.count, `${lamp.count} and ${sun.count} controls`);
    console.log(`${lamp.count} and ${sun.count} controls change the scene and are undone`);

    // A colour is what was picked, and shows.
    const before = await pictureOf(page);
    await page.locator('#panel input[type="color"] >> nth=1').fill('#808080');
    const { diffuseColor } = await sceneOf(page);
    assert.ok(Math.abs(diffuseColor[0] - 0.2159) < 1e-3, String(diffuseColor));
    assert.notEqual(await pictureOf(page), before);
    await finish(page);
  },

  async History()
  {
    const page = await open();
    await openHeights(page, 'hills.png', heights8);
    const first = JSON.stringify(await sceneOf(page));
    const firstPicture = await pictureOf(page);
    await page.focus('#frame');
    const box = await centre(page);
    await page.mouse.move(...box.at(0.2, 0.2));
    await page.mouse.down();
    await page.mouse.move(...box.at(0.4, 0.3));
    await page.mouse.move(...box.at(0.6, 0.7));
    await page.mouse.up();
    const dragged = JSON.stringify(await sceneOf(page));
    assert.notEqual(dragged, first);
    // A whole drag is one step.
    await page.keyboard.press('Control+z');
    assert.equal(JSON.stringify(await sceneOf(page)), first);
    assert.equal(await pictureOf(page), firstPicture);
    assert.ok(await page.isDisabled('#undo'));
    await page.keyboard.press('Control+Shift+Z');
    assert.equal(JSON.stringify(await sceneOf(page)), dragged);
    await page.click('#reset');
    assert.equal(JSON.stringify(await sceneOf(page)), first);
    assert.equal(await pictureOf(page), firstPicture);
    await page.click('#undo');
    assert.equal(JSON.stringify(await sceneOf(page)), dragged);
    await page.click('#redo');
    assert.equal(JSON.stringify(await sceneOf(page)), first);
    await finish(page);
  },

  // What is saved is what reliefshade makes of the saved scene, and links carry it.
  async Scenes()
  {
    const page = await open();
    const field = path.join(values.output, 'hills.png');
    fs.writeFileSync(field, heights16);
    await openHeights(page, 'hills.png', heights16);
    await page.check('text=Point >> input');
    await page.click('text="Add"');
    await page.check('text=Sun >> input');
    await page.locator('#panel input[type="color"] >> nth=0').fill('#ffc080');
    await page.check('text=Light from all around >> input');
    await page.evaluate(() => globalThis.reliefPage.changeScene(
      { specularCoefficient: 0.3, specularPower: 6, subsurfaceDepth: 2.5, forwardScatterCoefficient: 0.2 }));
    const scene = await downloadBy(page, 'Save scene');
    const picture = await downloadBy(page, 'Save picture');
    const saved = decode(fs.readFileSync(picture));
    assert.deepEqual([saved.width, saved.height, saved.depth], [COLUMNS, ROWS, 8]);
    compareWithNative(field, scene, saved);
    const { worst, share } = await page.evaluate(() => globalThis.reliefPage.compare());
    console.log(`what is shown and the exact sums differ by ${worst} of 255 at most, ${100 * share} % by more than 2`);
    assert.ok(share <= 1e-3, `${share} of the samples differ`);

    // Opened again, after other changes.
    const kept = await sceneOf(page);
    await page.click('#reset');
    await give(page, () => page.click('text="Open scene…"'), 'scene.json', fs.readFileSync(scene));
    const again = await downloadBy(page, 'Save scene');
    assert.equal(fs.readFileSync(again, 'utf8'), fs.readFileSync(scene, 'utf8'));

    // By a link, over an example.
    await page.selectOption('#example', 'terrain');
    await page.waitForFunction(() => globalThis.reliefPage.field.example === 'terrain');
    await page.focus('#frame');
    await page.keyboard.press('Shift+ArrowRight');
    const moved = await sceneOf(page);
    const link = await page.evaluate(() => globalThis.reliefPage.link());
    await finish(page);
    const other = await open({ hash: link.replace(/^[^#]*/, '') });
    const { reliefScene, ...linked } = await sceneOf(other);
    assert.equal(await other.evaluate(() => globalThis.reliefPage.field.example), 'terrain');
    for (const key of ['azimuth', 'altitude', 'intensity'])
    {
      assert.equal(linked.lights[0][key] ?? 1, moved.lights[0][key] ?? 1);
    }
    assert.equal(linked.subsurfaceDepth, moved.subsurfaceDepth);
    assert.ok(kept.environment);
    await finish(other);
    const bad = await open({ hash: '#nonsense' });
    assert.match(await alertOf(bad), /The link has no scene/);
    await finish(bad);
  },

  // Heights, textures, mask and environment of files; and files that are none.
  async Files()
  {
    const page = await open();
    const field = () => page.evaluate(() =>
    {
      const { width, height, spacing, origin, lengths, top } = globalThis.reliefPage.field;
      return { width, height, spacing, origin, lengths, top };
    });
    await openHeights(page, 'eight.png', heights8);
    assert.equal((await field()).width, COLUMNS);
    await openHeights(page, 'deep.png', heights16);
    assert.ok((await field()).top > 40000);
    await openHeights(page, 'map.tif', floatTiff());
    assert.deepEqual(await field(),
      { ...(await field()), lengths: true, spacing: [2, 2], origin: [1001, 5000 - 2 * ROWS + 1] });
    assert.equal(await alertOf(page), '');
    const jpeg = Buffer.from(await page.evaluate(async () =>
    {
      const canvas = new OffscreenCanvas(40, 30);
      const context = canvas.getContext('2d');
      context.fillRect(0, 0, 20, 30);
      return [...new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg' })).arrayBuffer())];
    }));
    await openHeights(page, 'photo.jpg', jpeg);
    assert.equal((await field()).width, 40);

    await openHeights(page, 'deep.png', heights16);
    let before = await pictureOf(page);
    for (const role of ['diffuse', 'mask', 'environment'])
    {
      if (role === 'environment')
      {
        await page.check('text=Light from all around >> input');
        await page.evaluate(() => globalThis.reliefPage.changeEnvironment({ image: 'file', file: 'sky.png' }));
      }
      await give(page, () => page.click(`[data-drop="${role}"] button >> nth=0`), `${role}.png`,
        role === 'mask' ? half : stripes);
      assert.equal(await alertOf(page), '');
      const after = await pictureOf(page);
      assert.notEqual(after, before, `${role} does not show`);
      before = after;
    }
    // The environment is turned by dragging, too.
    await page.check('text=Drag turns the environment >> input');
    const box = await centre(page);
    await page.mouse.move(...box.at(0.3, 0.5));
    await page.mouse.down();
    await page.mouse.move(...box.at(0.6, 0.5));
    await page.mouse.up();
    assert.ok(Math.abs((await sceneOf(page)).environment.rotationZ - 54) < 3);
    assert.notEqual(await pictureOf(page), before);

    const huge = Buffer.from(heights8);
    huge.writeUInt32BE(60000, 16);
    huge.writeUInt32BE(60000, 20);
    const bad = { 'text.txt': Buffer.from('no picture'), 'empty.png': Buffer.alloc(0),
      'short.png': heights16.subarray(0, 2000), 'huge.png': huge, 'short.tif': floatTiff().subarray(0, 3000),
      'head.png': heights16.subarray(0, 20) };
    for (const [name, buffer] of Object.entries(bad))
    {
      await openHeights(page, name, buffer);
      const text = await alertOf(page);
      assert.ok(text.includes(name) && text.length < 200 && !text.includes('\n'), `${name}: ${text}`);
      console.log(text);
      assert.equal((await field()).width, COLUMNS, 'what was open stays');
    }
    for (const [name, text, says] of [['a.json', '{', /no JSON/], ['b.json', '{"reliefScene": 1, "tolerance": -1}', /tolerance/],
      ['c.json', '[]', /reliefScene/]])
    {
      await give(page, () => page.click('text="Open scene…"'), name, Buffer.from(text));
      assert.match(await alertOf(page), says);
    }
    // By dropping, where a scene's file is told by its name.
    await page.evaluate((bytes) =>
    {
      const data = new DataTransfer();
      data.items.add(new File([new Uint8Array(bytes)], 'dropped.png'));
      document.querySelector('#stage').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true }));
    }, [...heights8]);
    await page.waitForFunction(() => globalThis.reliefPage.field.name === 'dropped.png');
    assert.equal(await alertOf(page), '');
    await finish(page);
  },

  // Lights by one click, as shade() has them under the same name.
  async Presets()
  {
    const page = await open();
    await openHeights(page, 'hills.png', heights16);
    await page.evaluate(() => globalThis.reliefPage.changeScene({ diffuseColor: [0.8, 0.6, 0.4] }));
    const before = JSON.stringify(await sceneOf(page));
    const buttons = page.getByRole('group', { name: 'Ways to light' }).getByRole('button');
    const names = (await buttons.allTextContents()).map((text) => text.toLowerCase().replaceAll(' ', '-'));
    assert.equal(names.length, 6);
    let last = null;
    for (const [k, name] of names.entries())
    {
      await buttons.nth(k).click();
      await page.waitForFunction((scene) => JSON.stringify(globalThis.reliefPage.state.scene) !== scene, last ?? before);
      last = JSON.stringify(await sceneOf(page));
      const apart = await page.evaluate(async (preset) =>
      {
        const { shade } = await import('./reliefshading/index.js');
        const { field, state } = globalThis.reliefPage;
        const { width, height, spacing } = field;
        const { heightScale, diffuseColor } = state.scene;
        const made = await shade(field.heights, { width, height, spacing, heightScale, diffuseColor, preset });
        const { data } = await globalThis.reliefPage.exact();
        return data.reduce((worst, code, at) => Math.max(worst, Math.abs(code - made.data[at])), 0);
      }, name);
      assert.equal(apart, 0, `${name} is lit otherwise`);
      assert.ok((await sceneOf(page)).lights.length > 0);
      if (name === 'sun-and-sky')
      {
        const { share } = await page.evaluate(() => globalThis.reliefPage.compare());
        assert.ok(share <= 1e-3, `${name}: ${share} of the samples are shown otherwise`);
      }
    }
    for (let k = 0; k < names.length; ++k)
    {
      await page.click('#undo');
    }
    assert.equal(JSON.stringify(await sceneOf(page)), before);
    await finish(page);
  },

  // Pictures of linear light as environments, far away and nearby, and as heights.
  async LinearFiles()
  {
    const page = await open();
    const field = path.join(values.output, 'linear-hills.png');
    fs.writeFileSync(field, heights16);
    await openHeights(page, 'linear-hills.png', heights16);
    await page.check('text=Shines >> input');
    await page.uncheck('text=Shines >> input');
    await page.check('text=Light from all around >> input');
    await page.evaluate(() => globalThis.reliefPage.changeScene({ subsurfaceDepth: 2, exposure: -1.5 }));
    const files = { 'around.exr': exrOf(panorama, AROUND, ['B', 'G', 'R']), 'around.hdr': radianceOf(panorama, AROUND) };
    const means = [];
    for (const [name, buffer] of Object.entries(files))
    {
      fs.writeFileSync(path.join(values.output, name), buffer);
      await page.evaluate(() => globalThis.reliefPage.changeEnvironment({ image: 'file', file: 'missing' }));
      await give(page, () => page.click('[data-drop="environment"] button >> nth=0'), name, buffer);
      assert.equal(await alertOf(page), '');
      for (const near of [false, true])
      {
        await page.setChecked('text=Infinitely far away >> input', !near);
        if (near)
        {
          await page.getByLabel('Radius, number').fill('30');
          await page.keyboard.press('Tab');
        }
        const scene = await downloadBy(page, 'Save scene');
        const saved = decode(fs.readFileSync(await downloadBy(page, 'Save picture')));
        compareWithNative(field, scene, saved);
        means.push(saved.data.reduce((sum, code) => sum + code, 0) / saved.data.length);
        const { worst, share } = await page.evaluate(() => globalThis.reliefPage.compare());
        assert.ok(share <= 1e-3, `${name}, ${near}: ${share} of the samples differ, by ${worst}`);
      }
    }
    assert.ok(Math.abs(means[0] - means[2]) < 2 && Math.abs(means[1] - means[3]) < 2, means.join(' '));
    assert.ok(means.every((mean) => mean > 20 && mean < 235) && Math.abs(means[0] - means[1]) > 1, means.join(' '));

    // Heights have their first row on top.
    const ramp = Float32Array.from({ length: COLUMNS * ROWS }, (_, k) => Math.floor(k / COLUMNS) + 0.25 * (k % COLUMNS));
    await openHeights(page, 'ramp.exr', exrOf(ramp, [COLUMNS, ROWS], ['Y']));
    assert.equal(await alertOf(page), '');
    const read = await page.evaluate(() => [...globalThis.reliefPage.field.heights]);
    assert.ok(read.every((height, k) => Math.abs(height - ramp[k]) < 1e-4), `${read.slice(0, 3)}`);
    const exr = files['around.exr'];
    const huge = Buffer.from(exr);
    huge.writeInt32LE(99999, exr.indexOf('dataWindow') + 21 + 8);
    huge.writeInt32LE(99999, exr.indexOf('dataWindow') + 21 + 12);
    for (const [name, buffer] of Object.entries({ 'short.exr': exr.subarray(0, 2000), 'head.exr': exr.subarray(0, 60), 'huge.exr': huge,
      'short.hdr': files['around.hdr'].subarray(0, 1500), 'head.hdr': Buffer.from('#?RADIANCE\n') }))
    {
      await openHeights(page, name, buffer);
      const text = await alertOf(page);
      assert.ok(text.includes(name) && text.length < 200 && !text.includes('\n'), `${name}: ${text}`);
      console.log(text);
    }
    await finish(page);
  },

  // Fields that no texture holds are shaded all the same, and it is said how.
  async LargeFields()
  {
    const page = await open();
    const host = () => page.evaluate(() => document.documentElement.dataset.host);
    const most = await page.evaluate(() =>
    {
      const { gl } = globalThis.reliefPage.picture.host.renderer;
      return gl.getParameter(gl.MAX_TEXTURE_SIZE);
    });
    const width = most + 8;
    const data = Uint16Array.from({ length: 6 * width }, (_, k) => 2000 * (1 + Math.sin((k % width) / 30)));
    await openHeights(page, 'long.png', Buffer.from(encode({ data, width, height: 6, channels: 1, depth: 16 })));
    await settled(page);
    assert.equal(await host(), 'WebAssembly');
    const text = await alertOf(page);
    assert.ok(text.includes(`${most}`) && text.length < 200, text);
    console.log(text);
    const shown = await page.evaluate(() =>
    {
      const { canvas } = globalThis.reliefPage.picture;
      const { data: pixels } = canvas.getContext('2d').getImageData(0, canvas.height / 2, canvas.width, 1);
      return new Set(pixels.filter((_, k) => k % 4 === 0)).size;
    });
    assert.ok(shown > 10, `${shown} shades are seen`);
    // Only as long as it is needed.
    await openHeights(page, 'hills.png', heights16);
    await settled(page);
    assert.equal(await host(), 'WebGL 2');
    assert.equal(await alertOf(page), '');
    await finish(page);
  },

  // An automatic exposure is that of all samples, whatever is seen.
  async Exposure()
  {
    const page = await open();
    const field = path.join(values.output, 'exposed-hills.png');
    fs.writeFileSync(field, heights16);
    await openHeights(page, 'exposed-hills.png', heights16);
    await page.check('text=Point >> input');
    await page.evaluate(() =>
    {
      const { reliefPage } = globalThis;
      const { position } = reliefPage.state.scene.lights[0];
      reliefPage.changeLight({ ...reliefPage.state.scene.lights[0], position: [10, 10, position[2] / 4], intensity: 0.3 });
      reliefPage.changeScene({ exposure: 'auto', diffuseColor: [0.6, 0.5, 0.4] });
      reliefPage.view.zoomBy(6, [5, 5]);
    });
    await settled(page);
    const { stops, exposure } = await page.evaluate(async () => ({
      stops: globalThis.reliefPage.picture.host.renderer.stops, exposure: (await globalThis.reliefPage.exact()).statistics.exposure,
    }));
    const codes = (exponent, x) => 255 * (1.055 * Math.min(x * 2 ** exponent, 1) ** (1 / 2.4) - 0.055);
    let worst = 0;
    for (let x = 0.004; x < 1; x *= 1.1)
    {
      worst = Math.max(worst, Math.abs(codes(stops, x) - codes(exposure, x)));
    }
    console.log(`${stops} stops, ${exposure} for the exact picture: ${worst.toFixed(3)} of 255`);
    assert.ok(Math.abs(exposure) > 0.2 && worst <= 0.5, `${stops}, ${exposure}`);
    const scene = await downloadBy(page, 'Save scene');
    compareWithNative(field, scene, decode(fs.readFileSync(await downloadBy(page, 'Save picture'))));
    // What moves does so by the one that was, and what rests has its own.
    await page.evaluate(() => globalThis.reliefPage.changeScene({ diffuseColor: [0.2, 0.2, 0.2] }));
    await settled(page);
    const after = await page.evaluate(() => globalThis.reliefPage.picture.host.renderer.stops);
    assert.ok(after > stops + 0.5, `${after} stops for what is darker`);
    await finish(page);
  },

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
        if (values.reliefshade && panel === panels[panels.length - 1] && !panel.texture)
        {
          const scene = path.join(values.output, 'figure-scene.json');
          const native = path.join(values.output, 'figure-native.png');
          fs.writeFileSync(scene, made.scene);
          const result = spawnSync(values.reliefshade,
            [path.join(values.output, `${name}.png`), native, '--scene', scene], { encoding: 'utf8' });
          assert.equal(result.status, 0, result.stderr);
          const expected = decode(fs.readFileSync(native));
          let wrong = 0;
          for (let k = 0; k < made.columns * made.lines; ++k)
          {
            const at = (c) => expected.data[expected.channels * k + Math.min(c, expected.channels - 1)];
            wrong += [0, 1, 2].some((c) => Math.abs(data[4 * k + c] - at(c)) > 2) ? 1 : 0;
          }
          assert.ok(wrong <= 1e-3 * made.columns * made.lines, `${title}: ${wrong} samples are others than reliefshade's`);
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
      const page = await open({ width, height, query, colorScheme: name === 'tablet' ? 'dark' : 'light' });
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

let failed = false;
try
{
  const late = new Promise((_, fail) =>
  {
    setTimeout(() => fail(new Error('the page takes too long')), 280000).unref();
  });
  await Promise.race([tests[positionals[0]](), late]);
}
catch (error)
{
  console.error(error);
  failed = true;
}
await browser.close();
server.close();
process.exit(failed ? 1 : 0);
