// SPDX-License-Identifier: BSD-3-Clause
//
// Light, view, controls and history.

import assert from 'node:assert/strict';

import { heights16, heights8 } from './files.mjs';
import {
  COLUMNS, ROWS, centre, finish, near, open, openHeights, pictureOf, sceneOf, settled, viewOf,
} from './harness.mjs';

export const tests = {
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
        const { shade } = await import('../package/index.js');
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
};
