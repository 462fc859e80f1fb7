// SPDX-License-Identifier: BSD-3-Clause
//
// The heights of a medallion: a sunflower with two whorls of petals, leaves, beads and a rim. Lengths are in radii
// of the medallion, as in Examples/Python/medallion_heights.py.

const field = 0.05; // height of the medallion's field above the plate that it lies on
const golden = Math.PI * (3 - Math.sqrt(5));

// Half an ellipse, across a line or about a point.
const ridge = (distance, halfWidth, height) =>
  height * Math.sqrt(Math.max(1 - (distance / halfWidth) ** 2, 0));

function petals(radius, angle) {
  let height = 0;
  for (const [shift, length, top] of [
    [0, 0.32, 0.045],
    [0.5, 0.23, 0.06],
  ]) {
    const along = Math.min(Math.max((radius - 0.25) / length, 0), 1);
    const across = 2 * ((((9 * angle) / Math.PI + shift) % 1) + 1) - 1;
    const place = across > 1 ? across - 2 : across;
    const width = Math.sqrt(Math.max(Math.sin(Math.PI * along ** 0.7), 0)) + 1e-6;
    const vein = 1 - 0.25 * Math.exp(-((place / 0.12) ** 2));
    const crest = top * vein * Math.sqrt(Math.max(Math.sin(Math.PI * (0.15 + 0.85 * along)), 0));
    height = Math.max(height, field + ridge(place, width, crest));
  }
  return height;
}

// Leaves in a wreath, each slanting across the band between two rings.
function wreath(radius, angle) {
  const count = 40;
  const turned = (angle / (2 * Math.PI)) * count + 9 * (radius - 0.73);
  const across = turned - Math.round(turned);
  const along = (radius - 0.73) / 0.1;
  const width = 0.46 * Math.sqrt(Math.max(1 - along * along, 0)) + 1e-6;
  return (
    0.03 * Math.sqrt(Math.max(1 - (across / width) ** 2, 0)) * (1 - 0.3 * Math.exp(-((across / 0.06) ** 2)))
  );
}

function addBall(heights, size, first, step, [cx, cy], radius, base) {
  const reach = Math.ceil(radius / step) + 1;
  const [column, row] = [cx, cy].map((c) => Math.round((c - first) / step));
  for (let j = row - reach; j <= row + reach; ++j) {
    for (let i = column - reach; i <= column + reach; ++i) {
      const square = radius ** 2 - (first + i * step - cx) ** 2 - (first + j * step - cy) ** 2;
      if (square > 0) {
        heights[j * size + i] = Math.max(heights[j * size + i], base + Math.sqrt(square));
      }
    }
  }
}

// Rounds edges, as wear does.
function smooth(heights, size) {
  const kernel = [0.06, 0.24, 0.4, 0.24, 0.06];
  for (const stride of [1, size]) {
    const before = Float64Array.from(heights);
    for (let k = 2 * stride; k < heights.length - 2 * stride; ++k) {
      heights[k] = kernel.reduce((sum, weight, at) => sum + weight * before[k + (at - 2) * stride], 0);
    }
  }
}

/** Heights of size x size samples. */
export function medallionHeights(size) {
  const step = 2.2 / size;
  const first = -1.1 + step / 2;
  const heights = new Float64Array(size * size);
  for (let j = 0; j < size; ++j) {
    for (let i = 0; i < size; ++i) {
      const [x, y] = [first + i * step, first + j * step];
      const [radius, angle] = [Math.hypot(x, y), Math.atan2(y, x)];
      let height = radius < 1 ? field : 0;
      height += ridge(radius - 0.95, 0.05, 0.05);
      height += ridge(radius - 0.855, 0.012, 0.015) + ridge(radius - 0.605, 0.012, 0.015);
      height += wreath(radius, angle);
      const flower = radius < 0.6 ? petals(radius, angle) : 0;
      const dome = radius < 0.27 ? field + ridge(radius, 0.27, 0.05) : 0;
      height = Math.max(height, flower, dome);
      heights[j * size + i] = height;
    }
  }
  for (let k = 1; k < 160; ++k) {
    const [r, turn] = [0.245 * Math.sqrt(k / 160), k * golden];
    const center = [r * Math.cos(turn), r * Math.sin(turn)];
    addBall(heights, size, first, step, center, 0.014 + (0.006 * k) / 160, field + ridge(r, 0.27, 0.05));
  }
  for (let k = 0; k < 96; ++k) {
    const turn = (k * Math.PI) / 48;
    addBall(heights, size, first, step, [0.893 * Math.cos(turn), 0.893 * Math.sin(turn)], 0.022, field);
  }
  smooth(heights, size);
  return { heights, step };
}
