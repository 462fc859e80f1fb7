// SPDX-License-Identifier: BSD-3-Clause
//
// TIFF, also of floats and with a place on a map.

import { fromArrayBuffer } from "geotiff";

import { metresOfDegree, metresOfWebMetre } from "./geodesy.js";

const webMercator = [3857, 3785, 900913, 102100, 102113];
const metre = /^m(et(er|re)s?)?$/i;
const alphas = [1, 2]; // of the tag ExtraSamples

// What a TIFF says of its place: spacing in metres, where degrees are, and the south-western sample.
function placeOf(image, height) {
  try {
    const [x, y] = image.getOrigin();
    const [dx, dy] = image.getResolution().map(Math.abs);
    const keys = image.getGeoKeys() ?? {};
    const half = keys.GTRasterTypeGeoKey === 2 ? 0 : 0.5;
    const metres =
      keys.GTModelTypeGeoKey === 2
        ? metresOfDegree
        : webMercator.includes(keys.ProjectedCSTypeGeoKey)
          ? metresOfWebMetre
          : undefined;
    if (metres) {
      const [mx, my] = metres(y - (dy * height) / 2);
      return { lengths: true, spacing: [dx * mx, dy * my], origin: [0, 0] };
    }
    return { lengths: true, spacing: [dx, dy], origin: [x + half * dx, y - (height - 1 + half) * dy] };
  } catch {
    return {}; // no georeference
  }
}

// What its heights are in, if that is said and is not what its spacing is in.
async function otherUnit(image) {
  const { UNITTYPE: unit = "" } = (await image.getGDALMetadata(0)) ?? {};
  const inMetres = (image.getGeoKeys()?.ProjLinearUnitsGeoKey ?? 9001) === 9001;
  return unit.trim() !== "" && inMetres && !metre.test(unit.trim()) ? unit.trim() : undefined;
}

/** @param checkSize   refuses what is too large, before it is decoded */
export async function readTiff(bytes, checkSize) {
  const tiff = await fromArrayBuffer(bytes.buffer);
  const image = await tiff.getImage();
  const [width, height] = [image.getWidth(), image.getHeight()];
  checkSize(width, height);
  const data = await image.readRasters({ interleave: true });
  const channels = data.length / (width * height);
  const { fileDirectory: tags } = image;
  const extra = tags.hasTag("ExtraSamples") ? [...(await tags.loadValue("ExtraSamples"))] : [];
  const alpha = alphas.includes(extra.at(-1));
  const place = placeOf(image, height);
  const unit = place.lengths ? await otherUnit(image) : undefined;
  return { data, width, height, channels, alpha, nodata: image.getGDALNoData(), unit, ...place };
}
