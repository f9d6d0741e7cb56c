// gazebo_reader.h -- reads what the bridge publishes on a topic, as Gazebo's own programs would.

#pragma once

#include <ignition/msgs/image.pb.h>

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <ignition/transport/Node.hh>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace insonify {

/// Keeps messages of one type.
class GazeboReader {
 public:
  GazeboReader(const std::string& topic, const std::string& type) {
    node_.SubscribeRaw(
        topic,
        [kept = kept_](const char* bytes, std::size_t size, const ignition::transport::MessageInfo&) {
          const std::lock_guard lock(kept->mutex);
          kept->messages.emplace_back(bytes, size);
          kept->arrived.notify_all();
        },
        type);
  }

  /// Whether so many have come, within some seconds.
  bool wait_for(std::size_t count, double seconds = 60) {
    std::unique_lock lock(kept_->mutex);
    return kept_->arrived.wait_for(lock, std::chrono::duration<double>(seconds),
                                   [&] { return kept_->messages.size() >= count; });
  }
  std::vector<std::string> messages() {
    const std::lock_guard lock(kept_->mutex);
    return kept_->messages;
  }
  std::size_t count() { return messages().size(); }

 private:
  // Callbacks own it too: one that runs while its topic is unsubscribed from is not waited for.
  struct Kept {
    std::mutex mutex;
    std::condition_variable arrived;
    std::vector<std::string> messages;
  };
  std::shared_ptr<Kept> kept_ = std::make_shared<Kept>();
  ignition::transport::Node node_;
};

/// The sonar image of a message, as docs/how-to/gazebo.md has it.
struct GazeboSonarImage {
  explicit GazeboSonarImage(const std::string& message) {
    if (!image.ParseFromString(message)) {
      throw std::runtime_error("no image");
    }
    time = static_cast<double>(image.header().stamp().sec()) + 1e-9 * image.header().stamp().nsec();
    for (const auto& entry : image.header().data()) {
      for (const std::string& value : entry.value()) {
        if (entry.key() == "ranges") {
          ranges.push_back(std::stod(value));
        } else if (entry.key() == "azimuths") {
          azimuths.push_back(std::stod(value));
        } else if (entry.key() == "seq") {
          number = std::stoul(value);
        } else if (entry.key() == "frame_id") {
          frame = value;
        }
      }
    }
    values.resize(image.data().size() / 2);
    std::memcpy(values.data(), image.data().data(), 2 * values.size());
  }

  /// Where the profile of the beams within an angle first reaches half of its greatest value [m].
  [[nodiscard]] double first_echo(double angle = 0.05) const {
    std::vector<double> profile(ranges.size());
    for (std::size_t bin = 0; bin < ranges.size(); ++bin) {
      for (std::size_t beam = 0; beam < azimuths.size(); ++beam) {
        profile[bin] += std::abs(azimuths[beam]) < angle ? values[bin * azimuths.size() + beam] : 0;
      }
    }
    double most = 0;
    for (const double value : profile) {
      most = std::max(most, value);
    }
    for (std::size_t bin = 0; bin < ranges.size(); ++bin) {
      if (profile[bin] >= most / 2) {
        return ranges[bin];
      }
    }
    return 0;
  }

  ignition::msgs::Image image;
  double time = 0;
  unsigned long number = 0;
  std::string frame;
  std::vector<double> ranges, azimuths;
  std::vector<std::uint16_t> values;  ///< [bin][beam]
};

}  // namespace insonify
