// SPDX-License-Identifier: BSD-3-Clause
//
// The page of Examples/Web in a headless browser, and what tests do with it. The arguments are those of run.mjs.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';

import { launch, serve } from '../webgl/browser.mjs';

export const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: Object.fromEntries(['page', 'package', 'browser', 'chromium', 'libraries', 'output', 'reliefshade']
    .map((name) => [name, { type: 'string' }])),
});
export const { encode, decode } = await import(
  pathToFileURL(path.join(values.libraries, 'node_modules', 'fast-png', 'lib', 'index.js')));
fs.mkdirSync(values.output, { recursive: true });

export const COLUMNS = 96;
export const ROWS = 80;
export const PATIENCE = 120000; // milliseconds, of machines that have other work

//--------------------------------------------------------------------------------------------------
// The page, with no other address to be reached.

export const browser = await launch(values.browser, values.chromium);
export const server = await serve({ page: values.page, package: values.package });
export const address = `${server.url}page/index.html`;

// What the driver says of reading back, and what drives the browser of what it was told.
const expected = /GPU stall due to ReadPixels|Service Worker registration blocked/;

// A small relief before the page's own examples, which take a graphics processor in software long.
async function beginSmall(context, png)
{
  const own = JSON.parse(fs.readFileSync(path.join(values.page, 'examples', 'examples.json'), 'utf8'));
  const small = {
    name: 'small', label: 'Small', file: 'small.png', field: { lengths: false, spacing: [1, 1], origin: [0, 0] },
    scene: { heightScale: 0.0003, lights: [{ kind: 'sun', azimuth: 315, altitude: 35 }] },
  };
  await context.route('**/examples/examples.json', (route) => route.fulfill({ json: [small, ...own] }));
  await context.route('**/examples/small.png', (route) => route.fulfill({ body: png, contentType: 'image/png' }));
}

// The page, with the examples that it has or with another one before them, and without files that are to be missing.
// What is asked for is in page.asked; init runs before the page's own script.
export async function open({ width = 620, height = 420, query = '?host=webgl', hash = '', small = true, png, init, missing,
  ...rest } = {})
{
  const context = await browser.newContext(
    { viewport: { width, height }, acceptDownloads: true, serviceWorkers: 'block', ...rest });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  page.complaints = [];
  page.asked = [];
  page.on('request', (request) => page.asked.push(request.url().replace(/.*\/page\//, '').replace(/[?#].*/, '')));
  page.on('console', (message) =>
  {
    const text = message.text();
    if (['error', 'warning'].includes(message.type()) && !expected.test(text))
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
  if (small)
  {
    await beginSmall(context, png ?? (await import('./files.mjs')).heights16);
  }
  if (missing)
  {
    await context.route(missing, (route) => route.abort());
  }
  if (init)
  {
    await page.addInitScript(init);
  }
  await page.goto(`${address}${query}${hash}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: PATIENCE });
  return page;
}

export const settled = (page) => page.evaluate(() => globalThis.reliefPage.picture.settled());
export const sceneOf = (page) => page.evaluate(() => globalThis.reliefPage.state.scene);
export const alertOf = (page) => page.evaluate(() => document.querySelector('#alert:not([hidden]) span')?.textContent ?? '');

// A number that another picture hardly has.
export async function pictureOf(page)
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
export async function give(page, click, name, buffer)
{
  const chosen = page.waitForEvent('filechooser');
  await click();
  await (await chosen).setFiles({ name, mimeType: 'application/octet-stream', buffer });
  await page.waitForTimeout(50);
  await page.waitForFunction(() => !document.body.hasAttribute('aria-busy'));
}

export const openHeights = (page, name, buffer) => give(page, () => page.click('#open'), name, buffer);

export async function downloadBy(page, button)
{
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(`text="${button}"`)]);
  const file = path.join(values.output, download.suggestedFilename());
  await download.saveAs(file);
  return file;
}

// Where the relief is: at(u, v) is a place on it, as a share from the left and from the top.
export const centre = async (page) =>
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

export const viewOf = (page) => page.evaluate(() =>
{
  const { zoom, center } = globalThis.reliefPage.view;
  return { zoom, center: [...center] };
});

export const near = (a, b, most) => a.every((c, k) => Math.abs(c - b[k]) <= most);

// What reliefshade makes of the files of heights and of a scene; null where there is no reliefshade.
export function nativePicture(field, scene, options = [])
{
  if (!values.reliefshade)
  {
    console.log('reliefshade is not there to be compared with');
    return null;
  }
  const file = path.join(values.output, `native-${positionals[0]}.png`);
  const result = spawnSync(values.reliefshade, [field, file, '--scene', scene, ...options], { encoding: 'utf8' });
  assert.equal(result.status, 0, result.stderr);
  return decode(fs.readFileSync(file));
}

// How far two pictures of any number of channels are apart, sample by sample.
export function distances(a, b)
{
  assert.deepEqual([a.width, a.height], [b.width, b.height]);
  // Grey pictures have one colour, with alpha or without.
  const at = (image, k, c) => image.data[image.channels * k + (image.channels < 3 ? 0 : c)];
  return Uint8Array.from({ length: a.width * a.height }, (_, k) =>
    Math.max(...[0, 1, 2].map((c) => Math.abs(at(a, k, c) - at(b, k, c)))));
}

// Whether what the page has saved is what reliefshade makes.
export function compareWithNative(field, scene, saved, options)
{
  const made = nativePicture(field, scene, options);
  if (made)
  {
    const worst = Math.max(...distances(saved, made));
    console.log(`the saved picture and that of reliefshade --scene differ by ${worst} of 255 at most`);
    assert.ok(worst <= 2, `${worst} of 255`);
  }
}

export async function finish(page)
{
  assert.deepEqual(page.complaints, [], 'the page complains');
  await page.context().close();
}
