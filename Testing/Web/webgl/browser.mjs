// SPDX-License-Identifier: BSD-3-Clause
//
// A page in a headless Chromium, with the modules and the tests' data behind a server of its own.

import fs from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';

const SKIPPED = 77;
const PATIENCE = 120000; // milliseconds, of machines that have other work
const TYPES = {
  '.js': 'text/javascript', '.mjs': 'text/javascript', '.html': 'text/html', '.json': 'application/json',
  '.css': 'text/css', '.png': 'image/png', '.wasm': 'application/wasm',
};
// A graphics processor in software, the same wherever the tests run.
export const FLAGS = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const PAGE = '<!doctype html><title>relief</title><link rel="icon" href="data:,"><canvas id="canvas"></canvas>';

// Ends the test: as skipped only where somebody has said that the browser is optional.
export function giveUp(reason)
{
  if (process.env.RELIEF_WEB_OPTIONAL)
  {
    console.log(`skipped: ${reason}`);
    process.exit(SKIPPED);
  }
  console.error(`${reason}; set RELIEF_WEB_OPTIONAL to skip the tests in a browser`);
  process.exit(1);
}

// Folders by the first part of an address: { modules: '/path' } answers /modules/x.
export async function serve(folders)
{
  const server = http.createServer((request, answer) =>
  {
    const [, first, ...rest] = decodeURIComponent(request.url.split('?')[0]).split('/');
    if (first === '')
    {
      answer.writeHead(200, { 'content-type': TYPES['.html'] }).end(PAGE);
      return;
    }
    const file = folders[first] && path.join(folders[first], path.normalize(`/${rest.join('/')}`));
    fs.readFile(file ?? '', (error, data) =>
    {
      const type = TYPES[path.extname(file ?? '')] ?? 'application/octet-stream';
      answer.writeHead(error ? 404 : 200, { 'content-type': type }).end(error ? '' : data);
    });
  });
  await new Promise((listening) => { server.listen(0, '127.0.0.1', listening); });
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export async function launch(browserFolder, chromium)
{
  if (!chromium || !fs.existsSync(chromium))
  {
    giveUp('there is no Chromium');
  }
  let playwright;
  try
  {
    playwright = createRequire(path.resolve(browserFolder, 'package.json'))('playwright-core');
  }
  catch (error)
  {
    giveUp(`there is no playwright-core in ${browserFolder} (npm)`);
  }
  return playwright.chromium.launch({ executablePath: chromium, headless: true, args: FLAGS, timeout: PATIENCE });
}

// A page of the server, and what it complains of.
export async function openPage(browser, url)
{
  const page = await browser.newPage();
  const complaints = [];
  page.on('console', (message) =>
  {
    const text = message.text();
    // What reading back costs is said once by the driver.
    if (['error', 'warning'].includes(message.type()) && !text.includes('GPU stall due to ReadPixels'))
    {
      complaints.push(text);
    }
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  await page.goto(url, { timeout: PATIENCE });
  return { page, complaints };
}
