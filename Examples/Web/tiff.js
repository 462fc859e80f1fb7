// SPDX-License-Identifier: BSD-3-Clause
//
// TIFF, also of floats and with a place on a map.

import { fromArrayBuffer } from "geotiff";

import { metresOfDegree, metresOfWebMetre } from "./geodesy.js";

const webMercator = [3857, 3785, 900913, 102100, 102113];
const metre = /^m(et(er|re)s?)?$/i;
const alphas = [1, 2]; // of the tag ExtraSamples
const pixelIsPoint = 2; // of the key GTRasterType

// What is worth a word of how it lies on its map.
function tellPlace(image, place) {
  const { fileDirectory: tags } = image;
  const matrix = tags.hasTag("ModelTransformation") ? tags.getValue("ModelTransformation") : [];
  if (place.lengths && (matrix[1] || matrix[4])) {
    return "is turned on its map: lights shine from the sides of the picture.";
  }
  const points = tags.hasTag("ModelTiepoint") ? tags.getValue("ModelTiepoint").length / 6 : 0;
  return !place.lengths && points > 1
    ? "has its place by control points, which are not used: samples lie 1 apart. gdalwarp makes a raster with a place."
    : undefined;
}

// The samples of a picture that was stored in another order, as the tag Orientation tells.
function upright({ data, width, height, ...rest }, orientation) {
  const { channels } = rest;
  const across = orientation >= 5; // columns are stored as rows
  const [columns, rows] = across ? [height, width] : [width, height];
  const fromRight = [2, 3, 7, 8].includes(orientation);
  const fromBelow = [3, 4, 6, 7].includes(orientation);
  const turned = new data.constructor(data.length);
  for (let row = 0, at = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column, at += channels) {
      const [x, y] = across ? [row, column] : [column, row];
      const from = channels * ((fromBelow ? height - 1 - y : y) * width + (fromRight ? width - 1 - x : x));
      for (let c = 0; c < channels; ++c) {
        turned[at + c] = data[from + c];
      }
    }
  }
  return { data: turned, width: columns, height: rows, ...rest };
}

// What a TIFF says of its place: spacing in metres, where degrees are, and the south-western sample.
function placeOf(image, height) {
  try {
    const [x, y] = image.getOrigin();
    const [dx, dy] = image.getResolution().map(Math.abs);
    const keys = image.getGeoKeys() ?? {};
    const half = keys.GTRasterTypeGeoKey === pixelIsPoint ? 0 : 0.5;
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
  const told = tellPlace(image, place);
  const picture = { data, width, height, channels, alpha, nodata: image.getGDALNoData(), unit, told, ...place };
  const orientation = tags.hasTag("Orientation") ? await tags.loadValue("Orientation") : 1;
  // On a map it is the place that counts.
  return place.lengths || !(orientation >= 2 && orientation <= 8) ? picture : upright(picture, orientation);
}
