// SPDX-License-Identifier: BSD-3-Clause
//
// What is asked of a planned light: how bright it is, and what its illumination depends on.

// The sum of a colour's components.
export const sumOf = (v) => Math.abs(v[0]) + Math.abs(v[1]) + Math.abs(v[2]);

// How bright a light makes level ground, about: the order in which lights are added, and what they count
// while some are missing.
export function strength(light)
{
  return sumOf(light.radiance) * (light.directional ? Math.max(light.vector[2], 0.05) : 1);
}

// All that the illumination of one light depends on: what is kept under an equal key is what would be traced.
export function illuminationKey(field, scene, light)
{
  const { medium } = scene;
  const key = [field.version, ...light.traced, light.positional, scene.combined, scene.igor, medium.depth,
    medium.surfaceNormal, medium.tangentPlane];
  if (scene.fixedStep)
  {
    // Algorithm 1 counts points: it knows no attenuation, floor or tolerance.
    return [...key, 'steps', scene.steps].join(' ');
  }
  return [...key, medium.exponential ? medium.density : '', medium.useFloor ? medium.floorHeight : '',
    medium.tolerance * light.toleranceScale].join(' ');
}
