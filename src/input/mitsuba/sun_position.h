// The position of the sun by date, time and place. M. Blanco-Muriel, D. C. Alarcon-Padilla,
// T. Lopez-Moratalla, M. Lara-Coira, "Computing the solar vector", Solar Energy 70(5), 2001.
#pragma once

namespace nephroid::mitsuba {

struct PlaceAndTime {
  double latitude = 35.6894, longitude = 139.6917;  ///< degrees north and east; Tokyo
  double time_zone = 9;                             ///< hours
  int year = 2010, month = 7, day = 10;
  double hour = 15, minute = 0, second = 0;  ///< local time
};

struct SunPosition {
  double zenith = 0;   ///< angle from the zenith, radians
  double azimuth = 0;  ///< from north to the east, radians from 0 to 2 pi
};

SunPosition sun_position(const PlaceAndTime& when);

}  // namespace nephroid::mitsuba
