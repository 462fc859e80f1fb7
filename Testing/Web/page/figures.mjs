// SPDX-License-Identifier: BSD-3-Clause
//
// The figures of chapter 4 of F. N. Pramananda Perumal's thesis, and those before it that show its effects, by the
// page's controls: a row of pictures each. What is set is what users set; labels are those that they read.

const HORIZON = [180, 90];

// The hue runs around the horizon once and fades to black overhead, as in the gallery.
export const rainbow = {
  size: HORIZON,
  values: Float32Array.from({ length: 3 * HORIZON[0] * HORIZON[1] }, (_, k) =>
  {
    const [i, j, c] = [Math.floor(k / 3) % HORIZON[0], Math.floor(k / 3 / HORIZON[0]), k % 3];
    const hue = ((6 * i) / HORIZON[0] + [0, 4, 2][c]) % 6;
    const strength = 3.6 * Math.sin(((j + 0.5) / HORIZON[1]) * Math.PI) ** 12;
    return 0.001 + strength * Math.min(Math.max(Math.abs(hue - 3) - 1, 0), 1);
  }),
};

// Half a ball on level ground, half of the picture wide.
export function ball(size)
{
  return Uint16Array.from({ length: size * size }, (_, k) =>
  {
    const [x, y] = [k % size, Math.floor(k / size)].map((c) => (4 * (c + 0.5)) / size - 2);
    return 65000 * Math.sqrt(Math.max(1 - x * x - y * y, 0));
  });
}

const sun = (azimuth, altitude) => ({ Azimuth: azimuth, Altitude: altitude });
const shine = { Diffuse: '#bfa080', 'Highlights: Power': 5, ...sun(300, 35) };
const behind = {
  kind: 'Point', place: [0.9, 0.15], Distance: -60, Diffuse: '#ffc189', Attenuation: 'Exponential', Density: 0.15, 'Depth t': 3,
  Floor: true, 'Floor height': -4, 'Automatic exposure': true,
};
const look = { 'Share k_s': 0.35, 'Highlights: Power': 8, ...sun(300, 30) };
const falloff = { Diffuse: '#bca98a', 'Share k_s': 0.7, ...sun(300, 40) };
const around = { Shines: false, 'Light from all around': true, file: 'rainbow.exr', Samples: 96 };

// Of each figure: its heights, and what each of its pictures has. Keys are labels, of sections whose
// labels are not the only ones; but for kind (of the light), place (of
// the dot, as shares of the relief), file (of the environment), texture (of the diffuse colour), preset and add.
export const figures = {
  'one sun (3.6)': { panels: [70, 40, 20, 8].map((altitude) => sun(315, altitude)) },
  'from all around (3.8)': { panels: [sun(300, 25), { preset: 'Sky dome' }, { preset: 'Sun and sky' }, around] },
  'highlights on a ball (3.13)': {
    heights: 'ball', panels: [{ 'Highlights: Power': 1 }, { 'Highlights: Power': 8 }, { 'Highlights: Power': 60 }, { 'Highlights: Range from': 0.9 }]
      .map((one) => ({ Diffuse: '#8095e3', 'Share k_s': 0.6, ...sun(300, 50), ...one })),
  },
  'a ball lit from behind (3.14)': {
    heights: 'ball', panels: [{ 'Share k_f': 0 }, { 'Share k_f': 0.5 }, { 'Share k_f': 1 }, { 'Share k_f': 1, 'Depth t': 12 }]
      .map((one) => ({ ...behind, ...one })),
  },
  'lamps (4.4)': {
    panels: [{ 'Light: Intensity': 0.5 }, {}, { place: [0.9, 0.4] },
      { 'Light: Intensity': 0.7, 'Light: Colour': '#ffe0bc', add: { place: [0.9, 0.3], 'Light: Intensity': 0.5, 'Light: Colour': '#b4d3ff' } }]
      .map((one) => ({ kind: 'Point', place: [0.1, 0.1], Distance: 60, ...one })),
  },
  'a rainbow, turned (4.5)': { panels: [0, 90, 180, 270].map((turn) => ({ ...around, Turn: turn })) },
  'diffuse light, highlights and shadow alone (4.6)': {
    panels: [{ Base: '#000000', Specular: '#000000' }, { Base: '#000000', Diffuse: '#000000' },
      { Base: '#000000', Specular: '#000000', 'Share k_s': 0, 'Depth t': 0 }, {}]
      .map((one) => ({ Base: '#2f3f59', Diffuse: '#f3c295', 'Share k_s': 0.3, 'Highlights: Power': 6, ...sun(300, 25), ...one })),
  },
  'the base colour (4.7)': {
    panels: ['#000000', '#595959', '#304689', '#7c2727'].map((base) => ({ Base: base, Diffuse: '#e7dacb', ...sun(300, 25) })),
  },
  'three colours (4.10)': {
    panels: [['#401a00', '#ed956c', '#fff3e7'], ['#003027', '#6ccca0', '#f3fff9'], ['#000046', '#4661cc', '#ffe095'],
      ['#616169', '#e7eaed', '#ffffff']].map(([base, diffuse, specular]) =>
      ({ ...look, Base: base, Diffuse: diffuse, Specular: specular })),
  },
  'from chalk to mirror (4.11)': { panels: [0, 0.3, 0.6, 1].map((share) => ({ ...shine, 'Share k_s': share })) },
  'from wax to glass (4.12)': { panels: [0, 0.33, 0.66, 1].map((share) => ({ ...behind, 'Share k_f': share })) },
  'falloffs (4.14)': {
    panels: [{}, { 'Highlights: Range to': 0.9, 'Highlights: Range from': 0.6 }, { 'Highlights: Range to': 0.8, 'Highlights: Range from': 0.8 }, { 'Highlights: Power': 12 }]
      .map((one) => ({ ...falloff, ...one })),
  },
  'materials (4.15)': {
    panels: [
      { Base: '#613027', Diffuse: '#f9cdb7', 'Share k_s': 0.12, 'Highlights: Power': 6, 'Depth t': 3, ...sun(300, 35) },
      { ...behind, 'Share k_f': 0.5, 'Share k_s': 0.05, 'Light: Colour': '#ffdaa0', 'Depth t': 5, Density: 0.1 },
      { Base: '#271a00', Diffuse: '#c59559', Specular: '#ffdca0', 'Share k_s': 0.55, 'Highlights: Power': 4, 'Depth t': 0.4, ...sun(300, 40) },
      { Diffuse: '#e1dcd4', 'Depth t': 0.28, ...sun(300, 35) }],
  },
  'styles under a rainbow (4.16)': {
    panels: [{ 'Depth t': 0.3 }, { 'Depth t': 6 }, { 'Depth t': 0.8, 'Share k_s': 0.6, 'Highlights: Power': 3 },
      { 'Depth t': 0.8, Samples: 16 }].map((one) => ({ ...around, Turn: 45, ...one })),
  },
  'depth t': { panels: [0, 0.5, 3, 20].map((depth) => ({ 'Depth t': depth, ...sun(315, 25) })) },
  'textures and masks': {
    panels: [{ texture: 'base' }, { texture: 'diffuse' }, { texture: 'specular', 'Share k_s': 0.8 }, { texture: 'mask' }]
      .map((one) => ({ Base: '#304060', ...sun(300, 40), ...one })),
  },
  'a wide sun': { panels: [0, 10, 30, 80].map((diameter) => ({ ...sun(315, 15), Diameter: diameter })) },
  'ways down and responses': {
    panels: [{ 'Way down': 'Vertical' }, { 'Way down': 'Normal' }, { preset: 'Combined' }, { preset: 'Igor' }]
      .map((one) => ({ ...one, 'Depth t': 4 })),
  },
};
