// SPDX-License-Identifier: BSD-3-Clause
//
// The integrated shading model: F. N. Pramananda Perumal, "An integrated model for direct
// illumination, subsurface scattering, specular highlights and shadow computation", MSc thesis,
// Texas A&M University, 2017. Section signs below are the thesis's; Documentation/Model.md has
// every rule in words.
//
// This text is compiled as it stands as C++17 (ReliefModel.h, in float and in double) and as
// GLSL 1.50 (ReliefPreludeGLSL.glsl). Dialect: literals end in f; no swizzles; structs have neither
// initialisers nor methods; outputs are RELIEF_OUT(type), or RELIEF_INOUT(type) where they are read too.
// It follows ReliefLeaves.glsl. ReliefSurface.glsl, ReliefSurroundings.glsl and ReliefThickness.glsl, which
// follow this text, measure the thickness that it needs.

// How light travels inside the material. Lengths are in the field's unit.
struct ReliefMedium
{
  real depth;       // t, how far the shading point is sunk below the surface
  int offset;       // RELIEF_VERTICAL, RELIEF_SURFACE_NORMAL or RELIEF_TANGENT_PLANE
  int attenuation;  // RELIEF_RECIPROCAL or RELIEF_EXPONENTIAL
  real density;     // a of the exponential attenuation, per unit of length
  bool useFloor;    // whether material ends below
  real floorHeight;
  real tolerance;   // bound on the error of d; 0 for all that the precision gives
};

const int RELIEF_VERTICAL = 0;
const int RELIEF_SURFACE_NORMAL = 1;
const int RELIEF_TANGENT_PLANE = 2;
const int RELIEF_RECIPROCAL = 0;
const int RELIEF_EXPONENTIAL = 1;

// How a surface answers a light.
const int RELIEF_ILLUMINATION = 0; // by d
const int RELIEF_COMBINED = 1;     // by slope and d
const int RELIEF_IGOR = 2;         // by slope and aspect

// The falloff controls of section 4.3.6.
struct ReliefFalloff
{
  real lo;
  real hi;
  real power;
};

//-------------------------------------------------------------------------------------------------
// Illumination, falloffs and the integrated equation

// d of section 3.2.1: the share of light that reaches a point behind a thickness r.
RELIEF_FN real reliefIllumination(ReliefMedium medium, real r)
{
  if (r >= RELIEF_INFINITY)
  {
    return 0.0f;
  }
  if (r <= medium.depth)
  {
    return 1.0f;
  }
  if (medium.attenuation == RELIEF_EXPONENTIAL)
  {
    return exp(-medium.density * (r - medium.depth));
  }
  return medium.depth / r;
}

// F of section 4.3.6, which reliefFalloffOf() says.
RELIEF_FN real reliefFalloff(ReliefFalloff falloff, real x)
{
  return reliefFalloffOf(falloff.lo, falloff.hi, falloff.power, x);
}

// R * l of section 3.4.
RELIEF_FN real reliefMirror(real3 n, real3 l)
{
  return reliefMirrorOf(n.x, n.y, n.z, l.x, l.y, l.z);
}

RELIEF_FN real reliefSpecularity(ReliefFalloff falloff, real3 n, real3 l)
{
  return reliefFalloff(falloff, reliefMirror(n, l));
}

// f of section 3.3.1.1: the eye looks along -z, so light from behind scatters toward it.
RELIEF_FN real reliefForwardScatter(ReliefFalloff falloff, real3 l)
{
  return reliefFalloff(falloff, -l.z);
}

// What stands in the place of d in the diffuse and scatter terms. For RELIEF_IGOR nothing looks at d.
RELIEF_FN real reliefResponse(int response, real d, real3 n, real3 l)
{
  if (response == RELIEF_COMBINED)
  {
    return reliefCombinedResponse(d, n.x, n.y, n.z, l.x, l.y, l.z);
  }
  if (response == RELIEF_IGOR)
  {
    return reliefIgorResponse(n.x, n.y, n.z, l.x, l.y);
  }
  return d;
}

// The four terms of the integrated equation (sections 3.5 and 4.3.7). `light` is the light's colour
// times its intensity times its weight; the colour of a sample is the base and, summed over the
// lights, the three others.
RELIEF_FN real3 reliefBaseTerm(real ks, real3 base)
{
  return (1.0f - ks) * base;
}

RELIEF_FN real3 reliefDiffuseTerm(real ks, real kf, real d, real3 light, real3 diffuse)
{
  return reliefDiffuseShare(ks, kf, d) * light * diffuse;
}

RELIEF_FN real3 reliefScatterTerm(real ks, real kf, real f, real d, real3 light, real3 diffuse)
{
  return reliefScatterShare(ks, kf, f, d) * light * diffuse;
}

RELIEF_FN real3 reliefSpecularTerm(real ks, real s, real3 light, real3 specular)
{
  return reliefSpecularShare(ks, s) * light * specular;
}

// A texture's colour, multiplied by its alpha, over what lies below it (T. Porter, T. Duff,
// "Compositing digital images", 1984, section 4.2).
RELIEF_FN real3 reliefOver(real3 texel, real alpha, real3 below)
{
  return texel + (1.0f - alpha) * below;
}

// What colours are multiplied by where they are shown, at an exposure in stops.
RELIEF_FN real reliefExposureFactor(real stops)
{
  return pow(real(2.0f), stops);
}

// Linear to sRGB, IEC 61966-2-1, clamped to [0, 1].
RELIEF_FN real reliefEncode(real linear)
{
  real c = clamp(linear, real(0.0f), real(1.0f));
  return c <= 0.0031308f ? 12.92f * c : 1.055f * pow(c, real(1.0f / 2.4f)) - 0.055f;
}

// sRGB to linear, the inverse on [0, 1].
RELIEF_FN real reliefDecode(real encoded)
{
  return reliefDecodeOf(clamp(encoded, real(0.0f), real(1.0f)));
}
