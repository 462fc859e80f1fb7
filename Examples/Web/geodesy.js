// SPDX-License-Identifier: BSD-3-Clause

/** Metres of a degree of longitude and of one of latitude, on the ellipsoid of WGS 84. */
export function metresOfDegree(latitude) {
  const degree = Math.PI / 180;
  const a = 6378137;
  const e2 = 0.00669437999014;
  const w = 1 - e2 * Math.sin(latitude * degree) ** 2;
  return [
    (a / Math.sqrt(w)) * Math.cos(latitude * degree) * degree,
    ((a * (1 - e2)) / (w * Math.sqrt(w))) * degree,
  ];
}

/** Metres on the ground, eastward and northward, for a metre of web maps, whose projection stretches all toward the poles. */
export function metresOfWebMetre(y) {
  const radius = 6378137;
  const latitude = Math.atan(Math.sinh(y / radius));
  const [mx, my] = metresOfDegree((latitude * 180) / Math.PI);
  const degree = (radius * Math.PI) / 180;
  return [mx / degree, (my * Math.cos(latitude)) / degree];
}
