// SPDX-License-Identifier: BSD-3-Clause
//
// What ReliefModel.glsl needs to be compiled as GLSL 1.50. The height field is not passed around but
// reached through uniforms, so its argument is a dummy.
#define real float
#define real3 vec3
#define RELIEF_FN
#define RELIEF_FIELD_FN
#define RELIEF_FIELD int
#define RELIEF_OUT(type) out type
#define RELIEF_INOUT(type) inout type
#define RELIEF_INFINITY reliefInfinity
#define RELIEF_NAN reliefNaN

const float RELIEF_EPSILON = 1.1920929e-7; // the step from 1 to the next number
const float reliefInfinity = 1.0 / 0.0;
const float reliefNaN = 0.0 / 0.0;
