// message_options.cpp -- limits of the options of messages, the rate of fan pictures, and the start of a run as a time
// of ISO 8601.

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdint>
#include <optional>

#include "insonify/error.h"
#include "insonify/messages.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

namespace chrono = std::chrono;

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kSecondsLimit = std::int64_t{1} << 31;  // Limit of the seconds in a ROS time.
constexpr std::size_t kFractionDigits = 9;                     // Digits after the point: nanoseconds.

// Reads a text from the left; `good` stays false once something was not as it should.
struct TimeReader {
  std::string_view left;
  bool good = true;

  bool skip(char wanted) {
    const bool found = left.starts_with(wanted);
    left.remove_prefix(found ? 1 : 0);
    return found;
  }
  void expect(char wanted) { good = skip(wanted) && good; }

  // A number of that many digits, from `least` to `most`.
  int number(std::size_t digits, int least, int most) {
    int value = 0;
    const std::string_view text = left.substr(0, digits);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    good = good && error == std::errc() && end == text.data() + digits && text.front() != '-' && value >= least &&
           value <= most;
    left.remove_prefix(text.size());
    return value;
  }

  // Digits after the point, as nanoseconds.
  std::int64_t fraction() {
    std::int64_t value = 0, unit = kNanosecondsPerSecond;
    const std::size_t before = left.size();
    for (; !left.empty() && left.front() >= '0' && left.front() <= '9'; left.remove_prefix(1)) {
      unit /= 10;
      value += unit * (left.front() - '0');
    }
    good = good && left.size() < before && before - left.size() <= kFractionDigits;
    return value;
  }

  // "Z", "+02:00", "-03:30".
  chrono::minutes zone() {
    if (skip('Z')) {
      return {};
    }
    const int sign = skip('-') ? -1 : 1;
    if (sign > 0) {
      expect('+');
    }
    const int hours = number(2, 0, 23);
    expect(':');
    return chrono::minutes(sign * (60 * hours + number(2, 0, 59)));
  }
};

}  // namespace

std::uint64_t start_from_text(std::string_view text) {
  TimeReader in{text};
  const chrono::year year(in.number(4, 0, 9999));
  in.expect('-');
  const chrono::month month(static_cast<unsigned>(in.number(2, 1, 12)));
  in.expect('-');
  const chrono::year_month_day day(year, month, chrono::day(static_cast<unsigned>(in.number(2, 1, 31))));
  in.expect('T');
  const chrono::hours hour(in.number(2, 0, 23));
  in.expect(':');
  const chrono::minutes minute(in.number(2, 0, 59));
  chrono::seconds second(0);
  std::int64_t fraction = 0;
  if (in.skip(':')) {
    second = chrono::seconds(in.number(2, 0, 59));
    fraction = in.skip('.') ? in.fraction() : 0;
  }
  const chrono::minutes zone = in.zone();
  if (!in.good || !in.left.empty() || !day.ok()) {
    throw Error(fmt::format("{} must be a time with its zone, such as 2026-06-01T10:00:00Z", printable(text)));
  }
  const std::int64_t seconds =
      chrono::duration_cast<chrono::seconds>(chrono::sys_days(day).time_since_epoch() + hour + minute + second - zone)
          .count();
  if (seconds < 0 || seconds >= kSecondsLimit) {
    throw Error(
        fmt::format("{} must be from 1970-01-01T00:00:00Z to before 2038-01-19T03:14:08Z, as ROS messages hold it",
                    printable(text)));
  }
  return static_cast<std::uint64_t>(seconds * kNanosecondsPerSecond + fraction);
}

std::string start_text(std::uint64_t start_ns) {
  const auto whole = static_cast<std::int64_t>(start_ns) / kNanosecondsPerSecond;
  const std::int64_t fraction = static_cast<std::int64_t>(start_ns) % kNanosecondsPerSecond;
  const chrono::sys_seconds time{chrono::seconds(whole)};
  const auto midnight = chrono::floor<chrono::days>(time);
  const chrono::year_month_day day(midnight);
  const chrono::hh_mm_ss clock(time - midnight);
  std::string digits = fraction == 0 ? "" : fmt::format(".{:09}", fraction);
  digits.erase(digits.find_last_not_of('0') + 1);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}Z", static_cast<int>(day.year()),
                     static_cast<unsigned>(day.month()), static_cast<unsigned>(day.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), digits);
}

void MessageOptions::validate() const {
  check_fields("messages", *this);
  if (bits != 8 && bits != 16) {
    throw Error("messages", "bits", fmt::format(" = {} must be 8 or 16", bits));
  }
  constexpr std::uint64_t kStartLimit = std::uint64_t{1'000'000'000} << 31U;  // [ns]
  if (start_ns && *start_ns >= kStartLimit) {
    throw Error("messages", "start_ns", fmt::format(" = {} ns must be below 2^31 s", *start_ns));
  }
  if (world_frame.empty()) {
    throw Error("messages", "world_frame", " must not be empty");
  }
}

std::optional<double> MessageOptions::fan_rate_of(const SonarConfig& sonar) const {
  const bool scans = sonar.product() == Product::kLine;
  return fan_rate || !scans ? fan_rate : std::optional(kScanningFanRate);
}

}  // namespace insonify
