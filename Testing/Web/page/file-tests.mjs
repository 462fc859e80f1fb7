// SPDX-License-Identifier: BSD-3-Clause
//
// Files that are opened and saved.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { AROUND, exrOf, floatTiff, half, heights16, heights8, hills, panorama, radianceOf, stripes } from './files.mjs';
import {
  COLUMNS, ROWS, alertOf, centre, compareWithNative, decode, downloadBy, encode, finish, give, near, open,
  openHeights, pictureOf, sceneOf, settled, values,
} from './harness.mjs';

// Which sample of the picture, from above, is stored at a column of a row, by the values of TIFF's tag Orientation.
const sampleAt = (column, row) => row * COLUMNS + column;
const [right, bottom] = [COLUMNS - 1, ROWS - 1];
const storedOrders = {
  1: (i, j) => sampleAt(i, j),
  2: (i, j) => sampleAt(right - i, j),
  3: (i, j) => sampleAt(right - i, bottom - j),
  4: (i, j) => sampleAt(i, bottom - j),
  5: (i, j) => sampleAt(j, i),
  6: (i, j) => sampleAt(right - j, i),
  7: (i, j) => sampleAt(right - j, bottom - i),
  8: (i, j) => sampleAt(j, bottom - i),
};

export const tests = {
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

    // What the page itself misses is said, too.
    for (const [missing, says] of [['**/files.worker.js', /reads files has failed/], ['**/small.png', /fetch|load/i]])
    {
      const broken = await open({ missing });
      assert.match(await alertOf(broken), says);
      // There is nothing to be moved yet, and nothing that it goes wrong by.
      await broken.mouse.click(200, 200);
      await broken.keyboard.press('ArrowLeft');
      await broken.keyboard.press('+');
      if (missing.endsWith('small.png'))
      {
        await openHeights(broken, 'eight.png', heights8);
        await settled(broken);
        assert.equal(await alertOf(broken), '');
      }
      broken.complaints = broken.complaints.filter((text) => !/Failed to load resource/.test(text));
      await finish(broken);
    }
  },

  // What a TIFF says of its samples: where there are none, what they are in, and metres that are longer than those of
  // the ground.
  async Rasters()
  {
    const page = await open({ query: '?host=wasm' });
    const field = () => page.evaluate(() =>
    {
      const { heights, spacing } = globalThis.reliefPage.whole;
      return { without: heights.filter(Number.isNaN).length, spacing };
    });
    const size = COLUMNS * ROWS;
    const halfAlpha = Float32Array.from({ length: 2 * size }, (_, k) => (k % 2 === 0 ? 100 + k % 7 : k < size ? 0 : 1));
    await openHeights(page, 'alpha.tif', floatTiff({ data: halfAlpha, samples: 2, more: [[338, 3, [2]]] }));
    assert.equal((await field()).without, size / 2);
    await openHeights(page, 'bands.tif', floatTiff({ data: halfAlpha, samples: 2 }));
    assert.equal((await field()).without, 0, 'a band that is not said to be alpha is none');
    const lowest = Float32Array.from({ length: size }, (_, k) => (k < 50 ? -3.4028234663852886e38 : 100 + k % 7));
    await openHeights(page, 'lowest.tif', floatTiff({ data: lowest }));
    assert.equal((await field()).without, 50);
    await settled(page);
    assert.equal(await alertOf(page), '');

    // Web Mercator at 60 degrees north, where a metre of it is half a metre of the ground.
    const keys = [34735, 3, [1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 3857]];
    await openHeights(page, 'web.tif', floatTiff({ northing: 8399738 + ROWS, more: [keys] }));
    const { spacing: [dx, dy] } = await field();
    assert.ok(Math.abs(dx - 1.0025) < 1e-3 && Math.abs(dy - 1.0008) < 1e-3, `${dx} and ${dy}`);
    const unit = (word) => [42112, 2, Buffer.from(`<GDALMetadata><Item name="UNITTYPE" sample="0" role="unittype">${word}</Item></GDALMetadata>\0`)];
    await openHeights(page, 'metres.tif', floatTiff({ more: [unit('metre')] }));
    assert.equal(await alertOf(page), '');
    await openHeights(page, 'feet.tif', floatTiff({ more: [unit('ft')] }));
    assert.match(await alertOf(page), /^“feet.tif” has heights in ft and a spacing in metres/);

    // A value that nobody declared, as all readers tell it; not one that lies among the others.
    const holes = (value) => Float32Array.from({ length: size }, (_, k) => (k < 50 ? value : 100 + k % 7));
    await openHeights(page, 'undeclared.tif', floatTiff({ data: holes(-9999) }));
    const told = `“undeclared.tif” has -9999 in 50 of ${size} samples, far from the next value, 100: it is taken for a height`;
    assert.ok((await alertOf(page)).startsWith(told), await alertOf(page));
    await openHeights(page, 'single.tif', floatTiff({ data: holes(-9999.9) }));
    assert.match(await alertOf(page), /^“single.tif” has -9999.9 in 50 of/);
    await openHeights(page, 'warped.tif', floatTiff({ data: holes(0) }));
    assert.match(await alertOf(page), /^“warped.tif” has 0 in 50 of/);
    await openHeights(page, 'sea.tif', floatTiff({ data: Float32Array.from({ length: size }, (_, k) => k % 60) }));
    assert.equal(await alertOf(page), '');

    // How it lies: turned on its map, by control points, stored in another order.
    const matrix = [34264, 12, [1.6, 1.2, 0, 1000, 1.2, -1.6, 0, 5000, 0, 0, 0, 0, 0, 0, 0, 1]];
    await openHeights(page, 'turned.tif', floatTiff({ place: [matrix] }));
    assert.match(await alertOf(page), /^“turned.tif” is turned on its map: /);
    assert.ok((await field()).spacing.every((length) => Math.abs(length - 2) < 1e-9), `${(await field()).spacing}`);
    const points = [33922, 12, [0, 0, 0, 10, 50, 0, 60, 0, 0, 90, 50, 0, 60, 40, 0, 95, 90, 0]];
    await openHeights(page, 'points.tif', floatTiff({ place: [points] }));
    assert.match(await alertOf(page), /^“points.tif” has its place by control points, which are not used/);
    const seen = Float32Array.from({ length: size }, (_, k) => k);
    for (const [orientation, stored] of Object.entries(storedOrders))
    {
      const [columns, rows] = orientation >= 5 ? [ROWS, COLUMNS] : [COLUMNS, ROWS];
      const data = Float32Array.from({ length: size }, (_, k) => seen[stored(k % columns, Math.floor(k / columns))]);
      await openHeights(page, `order${orientation}.tif`, floatTiff({ data, columns, place: [[274, 3, [Number(orientation)]]] }));
      assert.equal(await alertOf(page), '');
      assert.deepEqual(await page.evaluate(() => [...globalThis.reliefPage.whole.heights]), [...seen], `orientation ${orientation}`);
    }
    await openHeights(page, 'map.tif', floatTiff({ data: seen, more: [[274, 3, [3]]] }));
    assert.deepEqual(await page.evaluate(() => [...globalThis.reliefPage.whole.heights]), [...seen], 'on a map its place counts');

    // What is wrong with one field is not said of the next.
    await page.evaluate(() =>
    {
      const { reliefPage } = globalThis;
      const heights = new Float32Array(100).fill(-3e38);
      heights[5] = 0;
      const plain = { width: 10, height: 10, spacing: [1, 1], origin: [0, 0], lengths: true, name: 'plain', example: '' };
      reliefPage.show({ ...plain, heights });
      return reliefPage.show({ ...plain, heights: Float32Array.from({ length: 100 }, (_, k) => k % 7) })
        .then(() => reliefPage.alert(''));
    });
    await settled(page);
    assert.equal(await alertOf(page), '');
    const xyz = Buffer.from(radianceOf(panorama, AROUND).toString('latin1').replace('rgbe', 'xyze'), 'latin1');
    await openHeights(page, 'xyz.hdr', xyz);
    assert.match(await alertOf(page), /“xyz.hdr” cannot be opened: the Radiance picture is .*of a kind that is not read/);
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
    const data = Uint16Array.from({ length: 600 * width }, (_, k) => 2000 * (1 + Math.sin((k % width) / 300)));
    await openHeights(page, 'long.png', Buffer.from(encode({ data, width, height: 600, channels: 1, depth: 16 })));
    await settled(page);
    // Of so many samples no more than can be seen, until one looks closer.
    const made = () => page.evaluate(() => globalThis.reliefPage.picture.host.made.width);
    const before = await made();
    assert.ok(before < width / 8 && before > 500, `${before} samples across`);
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
    await page.evaluate(() => globalThis.reliefPage.view.zoomBy(3));
    await settled(page);
    assert.ok((await made()) > 2 * before, `${await made()} samples across, ${before} from afar`);
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

  // Once it was opened the page goes on without a network, even from the beginning.
  async Offline()
  {
    const page = await open({ query: '?host=wasm', serviceWorkers: 'allow', small: false });
    await page.waitForFunction(() => navigator.serviceWorker.controller);
    await page.context().setOffline(true);
    assert.equal(await page.evaluate(() => fetch('nowhere').then(() => 'there', () => 'gone')), 'gone');
    page.complaints = []; // of that
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    await page.selectOption('#example', 'terrain');
    await page.waitForFunction(() => globalThis.reliefPage.field.example === 'terrain');
    await openHeights(page, 'map.tif', floatTiff());
    assert.equal(await alertOf(page), '');
    const saved = decode(fs.readFileSync(await downloadBy(page, 'Save picture')));
    assert.deepEqual([saved.width, saved.height], [COLUMNS, ROWS]);
    await finish(page);
  },
};
