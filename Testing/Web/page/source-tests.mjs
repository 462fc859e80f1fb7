// SPDX-License-Identifier: BSD-3-Clause
//
// Heights that are found first: of meshes as seen from one side, and of normal maps.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { bowlObj, heights8, hills, normalPicture, png, stripes } from './files.mjs';
import {
  COLUMNS, ROWS, alertOf, compareWithNative, decode, downloadBy, finish, nativePicture, near, open, openHeights, pictureOf,
  sceneOf, settled, values,
} from './harness.mjs';

const fieldOf = (page) => page.evaluate(() =>
{
  const { heights, width, height, spacing, lengths, source } = globalThis.reliefPage.field;
  return { heights: [...heights], width, height, spacing, lengths, how: source?.how };
});

// Waits until the heights are read anew.
async function reread(page, change)
{
  const before = await page.evaluate(() => globalThis.reliefPage.readings);
  await change();
  await page.waitForFunction((count) => globalThis.reliefPage.readings > count &&
    !document.body.hasAttribute('aria-busy'), before);
}

const visible = (page, label) => page.getByLabel(label, { exact: true }).isVisible();

// The files of a field and its scene, and the picture that the page saves of them.
async function saved(page, name, content)
{
  const field = path.join(values.output, name);
  fs.writeFileSync(field, content);
  const scene = await downloadBy(page, 'Save scene');
  return { field, scene, picture: decode(fs.readFileSync(await downloadBy(page, 'Save picture'))) };
}

async function shot(page, name)
{
  await settled(page);
  await page.screenshot({ path: path.join(values.output, name) });
}

export const tests = {
  // By the dialog and by dropping, from every side, at any resolution; the same as reliefshade's.
  async Meshes()
  {
    const bowl = bowlObj();
    const page = await open();
    assert.equal(await visible(page, 'Seen from'), false, 'of heights of a picture there is nothing to choose');
    await openHeights(page, 'bowl.obj', bowl);
    // Where the bowl begins its quads have two corners in one place.
    assert.equal(await alertOf(page), 'Of the mesh are left out: 64 triangles without area.');
    let field = await fieldOf(page);
    assert.deepEqual([field.width, field.lengths, field.how.direction], [1024, true, [0, 0, 1]]);
    assert.equal(await visible(page, 'Seen from'), true);
    assert.equal(await visible(page, 'Read as'), false);
    await reread(page, async () =>
    {
      await page.getByLabel('Resolution, number').fill('240');
      await page.keyboard.press('Tab');
    });
    field = await fieldOf(page);
    assert.equal(Math.max(field.width, field.height), 240);
    const front = await pictureOf(page);

    // From above, where a lamp stays where it was on the picture, and all else as it was.
    await page.check('text=Point >> input');
    await page.evaluate(() => globalThis.reliefPage.changeScene({ specularCoefficient: 0.2, specularPower: 12 }));
    const place = () => page.evaluate(() =>
    {
      const { field, state } = globalThis.reliefPage;
      const [x, y] = state.scene.lights[0].position;
      return [0, 1].map((axis) => 0.5 + ([x, y][axis] - field.origin[axis]) / field.spacing[axis]).map(
        (samples, axis) => samples / [field.width, field.height][axis]);
    });
    const before = await place();
    await reread(page, () => page.getByLabel('Seen from').selectOption('0,1,0'));
    assert.ok(near(await place(), before, 1e-6), `${await place()}, ${before} before`);
    assert.equal((await sceneOf(page)).specularCoefficient, 0.2);
    field = await fieldOf(page);
    assert.ok(field.heights.every((h) => Number.isNaN(h) || (h > -1.001 && h < 20.001)), 'heights are along y, in the unit of the mesh');
    assert.ok(field.width === 240 && field.height > 190 && field.height < 210, `${field.width} x ${field.height}`);
    assert.notEqual(await pictureOf(page), front);
    await shot(page, 'mesh-from-above.png');
    let files = await saved(page, 'bowl.obj', bowl);
    compareWithNative(files.field, files.scene, files.picture, ['--view', '0,1,0', '--resolution', '240']);
    const { share } = await page.evaluate(() => globalThis.reliefPage.compare());
    assert.ok(share <= 2e-3, `${share} of the samples differ`);

    // From anywhere, with anything up.
    await reread(page, async () =>
    {
      await page.getByLabel('Direction', { exact: true }).fill('1, 2, 0.5');
      await page.keyboard.press('Tab');
    });
    await reread(page, async () =>
    {
      await page.getByLabel('Up', { exact: true }).fill('0,0,-1');
      await page.keyboard.press('Tab');
    });
    assert.equal(await page.getByLabel('Seen from').inputValue(), '');
    await shot(page, 'mesh-aslant.png');
    files = await saved(page, 'bowl.obj', bowl);
    compareWithNative(files.field, files.scene, files.picture,
      ['--view', '1,2,0.5', '--view-up', '0,0,-1', '--resolution', '240']);
    const { width } = await fieldOf(page);
    for (const words of ['0,0,0', '1,2', 'up'])
    {
      await page.getByLabel('Direction', { exact: true }).fill(words);
      await page.keyboard.press('Tab');
      assert.match(await alertOf(page), /Direction: .*three numbers that are not all 0 are expected/);
    }
    assert.equal((await fieldOf(page)).width, width);

    // Files that are none leave open what was.
    const text = bowl.toString();
    const bad = {
      'text.obj': 'Dear reader,\n', 'empty.obj': '', 'binary.obj': heights8, 'short.obj': text.slice(0, text.length - 7),
      'points.obj': text.replace(/^f.*\n/gm, ''), 'far.obj': `${text}f 1 2 99999\n`, 'flat.obj': 'v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n',
      'half.obj': text.slice(0, 9000),
    };
    for (const [name, content] of Object.entries(bad))
    {
      await openHeights(page, name, Buffer.from(content));
      const told = await alertOf(page);
      console.log(told);
      assert.ok(told.startsWith(`“${name}” cannot be opened: `) && told.length < 200 && !told.includes('\n'), `${name}: ${told}`);
      assert.equal((await fieldOf(page)).width, width);
    }

    // By dropping; and a picture afterwards has no side.
    await page.evaluate((content) =>
    {
      const data = new DataTransfer();
      data.items.add(new File([content], 'DROPPED.OBJ'));
      document.querySelector('#stage').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true }));
    }, text);
    await page.waitForFunction(() => globalThis.reliefPage.field.name === 'DROPPED.OBJ');
    await openHeights(page, 'eight.png', heights8);
    assert.equal(await visible(page, 'Seen from'), false);
    await finish(page);
  },

  // Heights in the colours of tiles, as reliefshade --encoding reads them.
  async Encodings()
  {
    const page = await open();
    const heights = Float32Array.from(hills(2000), (h) => h - 300.5);
    const codes = { terrarium: (h) => (h + 32768) * 256, 'terrain-rgb': (h) => (h + 10000) * 10 };
    for (const [encoding, codeOf] of Object.entries(codes))
    {
      const tile = png(Uint8Array.from({ length: 3 * heights.length },
        (_, k) => Math.round(codeOf(heights[Math.floor(k / 3)])) >> (16 - 8 * (k % 3)) & 255), 3, 8);
      await openHeights(page, `${encoding}.png`, tile);
      await reread(page, () => page.getByLabel('Read as').selectOption(encoding));
      const field = await fieldOf(page);
      const worst = field.heights.reduce((most, h, k) => Math.max(most, Math.abs(h - heights[k])), 0);
      assert.ok(worst <= 0.051, `${encoding}: ${worst}`);
      const files = await saved(page, `${encoding}.png`, tile);
      compareWithNative(files.field, files.scene, files.picture, ['--encoding', encoding]);
    }
    // Colours of 16 bits encode nothing.
    const deep = png(Uint16Array.from({ length: 3 * heights.length }, (_, k) => k % 60000), 3, 16);
    await openHeights(page, 'deep.png', deep);
    await page.getByLabel('Read as').selectOption('terrarium');
    await page.waitForFunction(() => document.querySelector('#alert:not([hidden]) span')?.textContent.includes('of 8 bits'));
    await finish(page);
  },

  // Pictures of normals are told from others, read either way, and give what reliefshade makes of them.
  async NormalMaps()
  {
    const page = await open();
    for (const [green, name] of [[1, 'up.png'], [-1, 'down.png']])
    {
      const picture = normalPicture(green);
      await openHeights(page, name, picture);
      assert.match(await alertOf(page), /looks like a picture of normals/);
      const field = await fieldOf(page);
      assert.deepEqual([field.width, field.height, field.lengths, field.how.as], [COLUMNS, ROWS, true, 'normals']);
      const files = await saved(page, name, picture);
      compareWithNative(files.field, files.scene, files.picture, ['--normal-map', 'auto']);
    }
    await shot(page, 'normals.png');
    // Both ways that green may point are one surface; the false one is another.
    const right = await fieldOf(page);
    await reread(page, () => page.getByLabel('Green', { exact: true }).selectOption('down'));
    assert.deepEqual((await fieldOf(page)).heights, right.heights);
    await reread(page, () => page.getByLabel('Green', { exact: true }).selectOption('up'));
    assert.notDeepEqual((await fieldOf(page)).heights, right.heights);
    for (const [method, least] of [['cliffs', 1e-6], ['path-sums', 1e-3]])
    {
      await reread(page, () => page.getByLabel('Method', { exact: true }).selectOption(method));
      const found = await fieldOf(page);
      const apart = found.heights.reduce((worst, h, k) => Math.max(worst, Math.abs(h - right.heights[k])), 0);
      assert.ok(apart > least, `${method}: ${apart}`);
      const files = await saved(page, 'down.png', normalPicture(-1));
      compareWithNative(files.field, files.scene, files.picture, ['--normal-map', 'up', '--normal-method', method]);
    }
    // By its brightness, as reliefshade reads it without being told.
    await reread(page, () => page.getByLabel('Read as').selectOption('brightness'));
    assert.equal(await visible(page, 'Green'), false);
    const plain = await fieldOf(page);
    assert.equal(plain.lengths, false);
    const { heightScale } = await sceneOf(page);
    assert.ok(heightScale > 0 && heightScale !== 1, `${heightScale}`);
    // A coloured picture that is no normal map is left alone, but may be read as one.
    await openHeights(page, 'stripes.png', stripes);
    assert.equal(await alertOf(page), '');
    assert.equal((await fieldOf(page)).how.as, 'brightness');
    await reread(page, () => page.getByLabel('Read as').selectOption('normals'));
    assert.equal((await fieldOf(page)).lengths, true);
    assert.ok(nativePicture(path.join(values.output, 'down.png'), await downloadBy(page, 'Save scene'), ['--normal-map', 'up']) !== undefined);
    // The page answers while heights are found.
    const most = await page.evaluate(async () =>
    {
      const { reliefPage } = globalThis;
      const [width, height] = [700, 500];
      const canvas = new OffscreenCanvas(width, height);
      const pixels = new ImageData(width, height);
      for (let k = 0; k < width * height; ++k)
      {
        const [x, y] = [Math.sin((k % width) / 9) / 2, Math.cos(k / width / 11) / 2];
        const length = Math.hypot(x, y, 1);
        pixels.data.set([...[x, y, 1].map((c) => Math.round(127.5 * (c / length + 1))), 255], 4 * k);
      }
      canvas.getContext('2d').putImageData(pixels, 0, 0);
      const file = new File([await canvas.convertToBlob()], 'waves.png');
      await reliefPage.open(file, 'heights');
      let [longest, last, running] = [0, performance.now(), true];
      const tick = () =>
      {
        longest = Math.max(longest, performance.now() - last);
        last = performance.now();
        if (running)
        {
          setTimeout(tick, 5);
        }
      };
      tick();
      const begin = performance.now();
      await reliefPage.openHeights(file, { ...reliefPage.whole.source.how, method: 'cliffs' });
      running = false;
      return { longest, whole: performance.now() - begin };
    });
    console.log(`heights by cliffs took ${most.whole.toFixed()} ms, and the page waited ${most.longest.toFixed()} ms at most`);
    assert.ok(most.longest < most.whole / 2, `${most.longest} of ${most.whole} ms`);
    await finish(page);
  },
};
