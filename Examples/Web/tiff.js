// SPDX-License-Identifier: BSD-3-Clause
//
// TIFF, also of floats and with a place on a map.

import { fromArrayBuffer } from "geotiff";

import { metresOfDegree } from "./geodesy.js";

// What a TIFF says of its place: spacing in metres, where degrees are, and the south-western sample.
function placeOf(image, height) {
  try {
    const [x, y] = image.getOrigin();
    const [dx, dy] = image.getResolution().map(Math.abs);
    const keys = image.getGeoKeys() ?? {};
    const half = keys.GTRasterTypeGeoKey === 2 ? 0 : 0.5;
    if (keys.GTModelTypeGeoKey === 2) {
      const [mx, my] = metresOfDegree(y - (dy * height) / 2);
      return { lengths: true, spacing: [dx * mx, dy * my], origin: [0, 0] };
    }
    return { lengths: true, spacing: [dx, dy], origin: [x + half * dx, y - (height - 1 + half) * dy] };
  } catch {
    return {}; // no georeference
  }
}

/** @param checkSize   refuses what is too large, before it is decoded */
export async function readTiff(bytes, checkSize) {
  const tiff = await fromArrayBuffer(bytes.buffer);
  const image = await tiff.getImage();
  const [width, height] = [image.getWidth(), image.getHeight()];
  checkSize(width, height);
  const data = await image.readRasters({ interleave: true });
  const channels = data.length / (width * height);
  return { data, width, height, channels, nodata: image.getGDALNoData(), ...placeOf(image, height) };
}
