#include "input/mitsuba/sun_position.h"

#include <cmath>

#include "core/math.h"

namespace nephroid::mitsuba {
namespace {

/// Julian day number at noon of a date in the Gregorian calendar (Fliegel & van Flandern 1968).
int julian_day(int year, int month, int day) {
  const int shift = (month - 14) / 12;
  return (1461 * (year + 4800 + shift)) / 4 + (367 * (month - 2 - 12 * shift)) / 12 -
         (3 * ((year + 4900 + shift) / 100)) / 4 + day - 32075;
}

double positive(double angle) {
  return angle < 0 ? angle + 2 * kPiDouble : angle;
}

}  // namespace

SunPosition sun_position(const PlaceAndTime& when) {
  const double hours =
      when.hour - when.time_zone + (when.minute + when.second / 60) / 60;  // universal time
  const double days = julian_day(when.year, when.month, when.day) - 0.5 + hours / 24 - 2451545.0;
  // Ecliptic coordinates.
  const double omega = 2.1429 - 0.0010394594 * days;
  const double mean_longitude = 4.8950630 + 0.017202791698 * days;
  const double anomaly = 6.2400600 + 0.0172019699 * days;
  const double longitude = mean_longitude + 0.03341607 * std::sin(anomaly) +
                           0.00034894 * std::sin(2 * anomaly) - 0.0001134 -
                           0.0000203 * std::sin(omega);
  const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(omega);
  // Celestial coordinates.
  const double right_ascension =
      positive(std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  // Local coordinates.
  const double sidereal_hours = 6.6974243242 + 0.0657098283 * days + hours;
  const double hour_angle = (sidereal_hours * 15 + when.longitude) * kDegree - right_ascension;
  const double latitude = when.latitude * kDegree;
  SunPosition sun;
  sun.zenith = std::acos(std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) +
                         std::sin(declination) * std::sin(latitude));
  sun.azimuth =
      positive(std::atan2(-std::sin(hour_angle), std::tan(declination) * std::cos(latitude) -
                                                     std::sin(latitude) * std::cos(hour_angle)));
  // Parallax: the radius of the earth over the distance of the sun, in km.
  sun.zenith += 6371.01 / 149597890 * std::sin(sun.zenith);
  return sun;
}

}  // namespace nephroid::mitsuba
