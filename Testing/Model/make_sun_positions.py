# SPDX-License-Identifier: BSD-3-Clause
"""Makes SunPositions.h: where the sun is seen, by two implementations that are not ours.

    python3 -m venv venv && venv/bin/pip install astropy pvlib
    venv/bin/python make_sun_positions.py > SunPositions.h

Without air the place is astropy's (ERFA's, the IAU's standards), with air pvlib's (NREL's solar
position algorithm). Both take UTC for the Earth's rotation. The test itself needs neither.
"""

import datetime
import math
import warnings

import astropy.units as u
import numpy as np
import pvlib
from astropy.coordinates import AltAz, EarthLocation, get_sun
from astropy.time import Time
from astropy.utils import iers
from pvlib import spa

iers.conf.auto_download = False
iers.conf.iers_degraded_accuracy = "ignore"
warnings.simplefilter("ignore")

# Longitude, latitude and height above sea level; times in UTC.
PLACES = {
    "Boulder": (-105.25, 40.02, 1655), "Berlin": (13.4, 52.52, 34), "Quito": (-78.47, -0.18, 2850),
    "Sydney": (151.21, -33.87, 20), "Ushuaia": (-68.3, -54.8, 10), "Tromso": (18.96, 69.65, 0),
    "McMurdo": (166.67, -77.85, 10), "North Pole": (0.0, 90.0, 0), "South Pole": (0.0, -90.0, 2835),
    "west of the date line": (179.99, -16.8, 0), "east of the date line": (-179.99, 65.9, 0),
    "Lhasa": (91.1, 29.65, 3650), "Dead Sea": (35.47, 31.5, -430), "Everest": (86.925, 27.988, 8849),
    "Nairobi": (36.82, -1.29, 1795), "Longyearbyen": (15.6, 78.2, 30)}
TIMES = {
    "Boulder": ["1903-10-17T19:30:30", "2026-06-21T12:40:00", "1999-12-31T23:30:00"],
    "Berlin": ["1900-01-01T10:00:00", "2026-06-21T04:30:00", "2100-12-31T12:00:00",
               "2000-02-29T15:15:00", "1945-05-08T22:01:00"],
    "Quito": ["2026-03-20T16:00:00", "1955-09-23T20:20:20", "2061-06-21T12:00:00"],
    "Sydney": ["2026-12-21T02:00:00", "1930-06-21T05:45:00", "2088-02-29T20:10:00"],
    "Ushuaia": ["2026-12-21T08:00:00", "1912-06-21T16:00:00", "2077-09-01T21:00:00"],
    "Tromso": ["2026-06-21T22:45:00", "2026-12-21T10:45:00", "1972-06-30T23:59:00",
               "2040-01-20T10:50:00"],
    "McMurdo": ["2026-12-21T12:50:00", "1911-06-21T01:00:00", "2099-10-24T00:30:00"],
    "North Pole": ["2026-06-21T00:00:00", "1909-04-06T12:00:00", "2026-12-21T18:00:00"],
    "South Pole": ["1911-12-14T12:00:00", "2026-06-21T06:00:00", "2100-01-01T00:00:00"],
    "west of the date line": ["2026-06-21T00:00:00", "1920-01-15T18:00:00", "2055-11-11T06:10:00"],
    "east of the date line": ["2026-06-21T00:00:00", "1867-10-18T00:00:00", "2044-03-03T21:00:00"],
    "Lhasa": ["2026-01-01T06:00:00", "1959-03-10T01:00:00", "2033-08-08T12:40:00"],
    "Dead Sea": ["2026-07-01T03:00:00", "1947-11-29T14:30:00", "2090-04-15T09:40:00"],
    "Everest": ["1953-05-29T05:45:00", "2026-10-01T00:20:00", "2066-02-02T11:30:00"],
    "Nairobi": ["1901-06-01T03:40:00", "2026-11-29T09:30:00", "2100-02-28T15:30:00"],
    "Longyearbyen": ["1906-07-01T00:00:00", "2026-02-16T11:00:00", "2085-08-22T22:00:00"]}
# By pvlib alone.
FAR = [("Berlin", "1610-01-07T10:00:00"), ("Quito", "1736-07-01T13:00:00"),
       ("Sydney", "2399-12-30T22:00:00"), ("Boulder", "2222-02-22T17:00:00"),
       ("Tromso", "1827-09-01T07:00:00")]


def standard_air(elevation):
    """ISO 2533: hectopascals and degrees Celsius."""
    return 1013.25 * (1 - 2.25577e-5 * elevation) ** 5.25588, 15 - 0.0065 * elevation


def by_astropy(time, longitude, latitude, elevation):
    moment = Time(time, scale="utc")
    moment.delta_ut1_utc = 0.0
    place = EarthLocation(lon=longitude * u.deg, lat=latitude * u.deg, height=elevation * u.m)
    sun = get_sun(moment).transform_to(AltAz(obstime=moment, location=place, pressure=0 * u.hPa))
    return sun.az.deg, sun.alt.deg


def by_pvlib(time, longitude, latitude, elevation, pressure, temperature):
    moment = datetime.datetime.fromisoformat(time + "+00:00")
    delta = spa.calculate_deltat(moment.year, moment.month)
    result = spa.solar_position(
        np.array([moment.timestamp()]), latitude, longitude, elevation, pressure, temperature, delta, 0.5667)
    return result[4][0], result[2][0]  # azimuth, altitude


def away(a, b):
    """Degrees between two places in the sky, azimuth and altitude."""
    along = math.remainder(a[0] - b[0], 360) * math.cos(math.radians(a[1]))
    return math.hypot(along, a[1] - b[1])


def main():
    rows = []
    for name, time in [(name, time) for name in PLACES for time in TIMES[name]] + FAR:
        longitude, latitude, elevation = PLACES[name]
        pressure, temperature = standard_air(elevation)
        bare = by_astropy(time, longitude, latitude, elevation)
        other = by_pvlib(time, longitude, latitude, elevation, 0.0, temperature)
        # Astropy knows leap seconds, but not how the Earth's rotation went centuries ago and will go.
        if (name, time) in FAR:
            bare = other
        assert away(bare, other) < 0.002, (name, time, bare, other)
        seen = by_pvlib(time, longitude, latitude, elevation, pressure, temperature)
        rows.append(f'  {{ "{time}Z", {longitude}, {latitude}, {elevation}, {bare[0]:.5f}, '
                    f'{bare[1]:.5f}, {seen[1]:.5f} }}, // {name}')
    import astropy
    print("// SPDX-License-Identifier: BSD-3-Clause\n"
          "#ifndef SunPositions_h\n#define SunPositions_h\n\n"
          "/// Where the sun is seen, in degrees: azimuth and altitude without air by astropy "
          f"{astropy.__version__}, the\n/// altitude through standard air by pvlib "
          f"{pvlib.__version__}. Made by make_sun_positions.py.\n"
          "struct SunSeen\n{\n  const char* time;\n  double longitude;\n  double latitude;\n"
          "  double elevation;\n  double azimuth;\n  double altitude;\n  double refracted;\n};\n\n"
          "// clang-format off\nconstexpr SunSeen SunsSeen[] = {")
    print("\n".join(rows))
    print("};\n// clang-format on\n\n#endif")


main()
