// sonar3d15_server.cpp -- looks along the sonar's field of view and sends what is there.

#include "emulate/sonar3d15_server.h"

#include <algorithm>
#include <boost/asio/ip/multicast.hpp>
#include <cmath>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/wire/range_image.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;

namespace {

constexpr int kWidth = 256, kHeight = 64;  // [pixels]

// The aperture whose slices have their middles where pixels have their directions: the outermost at the edges.
double aperture_of(double field_of_view, int pixels) {
  return field_of_view * pixels / (pixels - 1);
}

// Rows from below.
std::vector<std::uint16_t> pixels_of(const Channels& seen, double scale) {
  std::vector<std::uint16_t> pixels;
  for (int row = kHeight - 1; row >= 0; --row) {
    for (int column = 0; column < kWidth; ++column) {
      const double distance = seen.distance[static_cast<std::size_t>(row * kWidth + column)];
      pixels.push_back(std::isnan(distance) ? 0 : static_cast<std::uint16_t>(std::lround(distance / scale)));
    }
  }
  return pixels;
}

}  // namespace

Sonar3d15Server::Sonar3d15Server(const EmulateOptions& options, EmulatedSonar& sonar)
    : sonar_(sonar), socket_(loop_.context()), view_(sonar.config()) {
  error_code failure, other;
  const net::ip::address_v4 own = net::ip::make_address_v4(options.address, other);
  destination_ = {net::ip::make_address_v4(options.destination, failure), static_cast<unsigned short>(options.port)};
  if (failure || other) {
    throw InputError(fmt::format("--to {} must be an IPv4 address, such as 224.0.0.96, and so must --address {}",
                                 printable(options.destination), printable(options.address)));
  }
  socket_.open(destination_.protocol());
  socket_.set_option(net::ip::multicast::outbound_interface(network_with(own).address));
  constexpr double kWide = 40, kSlow = 0.2, kFast = 0.05;
  const bool wide = view_.azimuth_aperture > radians_from_degrees(kWide + 1e-6);
  travel_ = 2 * view_.max_range / sonar.sound_speed();
  period_ = std::max({travel_, sonar.given().ping_period.value_or(0), wide ? kSlow : kFast});
  view_.azimuth_aperture = aperture_of(view_.azimuth_aperture, kWidth);
  view_.elevation_aperture = aperture_of(view_.elevation_aperture, kHeight);
}

std::string Sonar3d15Server::destination() const {
  return fmt::format("{}:{}", destination_.address().to_string(), destination_.port());
}

void Sonar3d15Server::run() {
  look(WallClock::now());
  loop_.run();
}

// A pixel has 1 mm, or as much as 16 bits need for the range.
void Sonar3d15Server::look(WallClock::time_point due) {
  constexpr double kFinest = 1e-3, kMost = 65535;
  const WallClock::time_point transmitted = WallClock::now();
  const auto time = std::chrono::system_clock::now().time_since_epoch();
  const SonarConfig& sonar = sonar_.config();
  const double scale = std::max(kFinest, sonar.max_range / kMost);
  const RangeImage image{
      .time_ns = static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(time).count()),
      .sequence = number_++,
      .sound_speed = static_cast<float>(sonar_.sound_speed()),
      .range = static_cast<float>(sonar.max_range),
      .frequency = static_cast<std::uint32_t>(sonar.frequency),
      .width = kWidth,
      .height = kHeight,
      .horizontal_fov_deg = static_cast<float>(degrees_from_radians(sonar.azimuth_aperture)),
      .vertical_fov_deg = static_cast<float>(degrees_from_radians(sonar.elevation_aperture)),
      .pixel_scale = static_cast<float>(scale),
      .pixels = pixels_of(sonar_.look(view_, kWidth, kHeight), scale)};
  timer_.expires_at(transmitted + wall_clock_duration(travel_));
  timer_.async_wait([this, packet = encode_rip2(image), transmitted, due](error_code) {
    error_code failure;  // Nobody needs to listen.
    socket_.send_to(net::buffer(packet), destination_, 0, failure);
    if (failure) {
      report_.note_drop();
    }
    report_.note(transmitted, sonar_.computing_time());
    const WallClock::time_point next = std::max(due + wall_clock_duration(period_), WallClock::now());
    timer_.expires_at(next);
    timer_.async_wait([this, next](error_code) { look(next); });
  });
}

}  // namespace insonify
