// SPDX-License-Identifier: BSD-3-Clause
#ifndef UsualLight_h
#define UsualLight_h

namespace relief
{

///@{
/// Of the sun in a scene without lights and environment, and of new suns, in degrees: as
/// cartographers have it.
constexpr double UsualAzimuth = 315.0;
constexpr double UsualAltitude = 45.0;
///@}
/// Of the former only: what faces it squarely is not pure white yet.
constexpr double UsualIntensity = 0.95;
/// Of a clear sky.
constexpr double UsualTurbidity = 3.0;

}

#endif
