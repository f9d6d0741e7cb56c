// live_answers.cpp -- pings that somebody waits for: their images, or why there are none.

#include <utility>

#include "insonify/error.h"
#include "insonify/live_sender.h"
#include "live/live_state.h"

namespace insonify {

void LiveSender::ask(LiveDrive drive, std::size_t sonar, Answer answer) {
  {
    const std::lock_guard lock(mutex_);
    drive.request = ++last_request_;
    asked_.emplace(drive.request, Asked{static_cast<int>(sonar), std::move(answer)});
  }
  const std::uint64_t request = drive.request;
  drive.done = [this, request](const std::string& error) {
    std::unique_lock lock(mutex_);
    const auto found = asked_.find(request);
    const bool is_sent = found != asked_.end() && found->second.made;
    lock.unlock();
    if (!error.empty() || !is_sent) {
      this->answer(request, {}, error.empty() ? "the sonar does not ping yet: its ping_period is longer" : error);
    }
  };
  try {
    loop_->drive(std::move(drive));
  } catch (const Error& error) {
    this->answer(request, {}, error.what());
  }
}

// Whether ask() waits for this ping.
bool LiveSender::is_asked(const LivePing& ping) {
  const std::lock_guard lock(mutex_);
  const auto asked = asked_.find(ping.request);
  return asked != asked_.end() && asked->second.sonar == ping.sonar;
}

// Answers ask(), unless that is done.
void LiveSender::answer(std::uint64_t request, std::vector<std::byte> image, const std::string& error) {
  std::unique_lock lock(mutex_);
  const auto asked = asked_.extract(request);
  lock.unlock();
  if (!asked.empty()) {
    asked.mapped().answer(std::move(image), error);
  }
}

// At the end.
void LiveSender::answer_all() {
  std::unique_lock lock(mutex_);
  const auto unanswered = std::exchange(asked_, {});
  lock.unlock();
  for (const auto& [request, asked] : unanswered) {
    asked.answer({}, kEnds);
  }
}

}  // namespace insonify
