// own_domain.h -- a DDS domain for one test alone.

#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>

namespace insonify {

// Until writers and readers have found each other from both sides, which each looks for once a second.
inline constexpr std::chrono::milliseconds kDiscovery{2500};

// A domain that no other process of these tests uses at the same time, nor a bridge that one of them has left.
class OwnDomain {
 public:
  OwnDomain() {
    for (number_ = 40; number_ < 100; ++number_) {
      const std::string name = "/tmp/insonify-dds-domain-" + std::to_string(number_);
      file_ = ::open(name.c_str(), O_RDWR | O_CREAT, 0666);
      if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) {
        return;
      }
      ::close(file_);
    }
    throw std::runtime_error("all domains are in use");
  }
  OwnDomain(const OwnDomain&) = delete;
  OwnDomain& operator=(const OwnDomain&) = delete;
  ~OwnDomain() { ::close(file_); }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_ = 0, file_ = -1;
};

}  // namespace insonify
