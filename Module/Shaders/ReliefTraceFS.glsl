// SPDX-License-Identifier: BSD-3-Clause
//
// The illumination d of one light, or what stands in its place, one texel for each texel of the grid.

//RELIEF::If FixedStep
uniform int lightSteps;
//RELIEF::End

void main()
{
  ivec2 at = gridSample(gridHere());
  float d = 0.0;
  if (!isnan(reliefHeight(0, at.x, at.y)))
  {
    ReliefMedium medium = lightMedium();
    //RELIEF::If Normals
    vec3 n = reliefNormal(0, at.x, at.y);
    //RELIEF::Else
    vec3 n = vec3(0.0, 0.0, 1.0);
    //RELIEF::End
    vec3 l;
    ReliefRay ray = lightRay(medium, at, n, l);
    //RELIEF::If Igor
    d = reliefResponse(RELIEF_IGOR, 0.0, n, l);
    //RELIEF::Else
    //RELIEF::If FixedStep
    d = 1.0 / (1.0 + float(reliefStepCount(0, ray, lightSteps)));
    //RELIEF::Else
    //RELIEF::If Deep
    d = reliefMeasured(medium, reliefTrace(0, medium, ray));
    //RELIEF::Else
    ReliefTrace trace;
    d = reliefExact(0, medium, ray, n, l, trace);
    //RELIEF::End
    //RELIEF::End
    //RELIEF::If Combined
    d = reliefResponse(RELIEF_COMBINED, d, n, l);
    //RELIEF::End
    //RELIEF::End
  }
  gl_FragData[0] = vec4(d);
}
