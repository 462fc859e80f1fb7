// SPDX-License-Identifier: BSD-3-Clause
//
// Heights that look as if one of their values meant no data, and nobody says so.

// The numbers that files mark with, the same as reliefshade's.
const usual = [
  -999, -9999, -99999, -999999, -9999999, -999.9, -9999.9, -32768, -32767, 9999, 99999, 32767, 65535,
];
const noHeight = 1e9; // of any unit in use

// 0 only where it is in a corner of a map: what gdalwarp leaves there.
const isMarker = (value, ofMap) =>
  Math.abs(value) >= noHeight ||
  usual.some((one) => Math.abs(value - one) <= 1e-6 * Math.abs(one)) ||
  (ofMap && value === 0);

// The shortest number that is the same in single precision.
function shortest(value) {
  const digits = [6, 7, 8, 9].find((count) => Math.fround(value.toPrecision(count)) === value);
  return digits ? Number(value.toPrecision(digits)) : value;
}

/**
 * What to tell of heights whose lowest or highest value is there more than once, far from all others and one
 * that files mark with, as reliefshade tells it; undefined of all others.
 */
export function tellUndeclared(heights, width, ofMap) {
  let [low, high, count] = [Infinity, -Infinity, 0];
  for (const value of heights) {
    if (!Number.isNaN(value)) {
      low = Math.min(low, value);
      high = Math.max(high, value);
      count += 1;
    }
  }
  const markers = [low, high].map((value) => isMarker(value, ofMap));
  if (!markers.includes(true) || !(low < high)) {
    return undefined;
  }
  let [nextLow, nextHigh, atLow, atHigh] = [Infinity, -Infinity, 0, 0];
  for (const value of heights) {
    atLow += value === low ? 1 : 0;
    atHigh += value === high ? 1 : 0;
    nextLow = value > low && value < nextLow ? value : nextLow;
    nextHigh = value < high && value > nextHigh ? value : nextHigh;
  }
  const corners = [0, width - 1, heights.length - width, heights.length - 1].map((k) => heights[k]);
  const ends = [
    { value: low, times: atLow, next: nextLow, rest: (markers[1] ? nextHigh : high) - nextLow },
    { value: high, times: atHigh, next: nextHigh, rest: nextHigh - (markers[0] ? nextLow : low) },
  ];
  const found = ends.find(({ value, times, next, rest }, k) => {
    const gap = Math.abs(value - next);
    // What is also the white of a picture must have more than black beside it.
    const marks = value < 0 || value >= noHeight || rest > 0;
    const apart = value === 0 ? gap > rest && corners.includes(value) : gap > 0.5 * rest;
    return markers[k] && times >= 2 && marks && apart;
  });
  return (
    found &&
    `has ${shortest(found.value)} in ${found.times} of ${count} samples, far from the next value, ${shortest(found.next)}: ` +
      "it is taken for a height and looks like no data. Declare it in the file, or leave it out by a mask."
  );
}
