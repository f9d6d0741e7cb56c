// hub.cpp -- passes pings from the source's thread to the server's, and encodes messages for all clients.

#include "serve/hub.h"

#include <fmt/format.h>

#include <algorithm>

#include "console/console.h"

namespace insonify {
namespace {

// One line with pings, size, names and folder.
std::string recorded_text(const LiveRecording& recording) {
  std::string names;
  for (const std::filesystem::path& file : recording.files) {
    names += (names.empty() ? "" : ", ") + file.filename().string();
  }
  if (recording.pings == 0) {
    return fmt::format("no ping was recorded, and no file kept as {}", names);
  }
  const std::filesystem::path folder = std::filesystem::absolute(recording.files.front()).parent_path();
  return fmt::format("recorded {} {}, {}: {}, with {}, in {}", recording.pings, recording.pings == 1 ? "ping" : "pings",
                     bytes_text(recording.bytes), names, recording.scenario.filename().string(),
                     folder.lexically_normal().string());
}

}  // namespace

const Bytes& SharedPing::frame(unsigned tables) {
  Bytes& frame = frames_[tables];
  if (!frame) {
    frame = ping_frame(*ping_, tables);
  }
  return frame;
}

void Hub::on_ping(const std::shared_ptr<const LivePing>& ping) {
  // If the server's thread cannot keep up, the oldest are dropped. The queue has room for a ping of every sonar.
  const std::size_t most_waiting = 8 + ping->world->sonars.size();
  const std::lock_guard lock(mutex_);
  waiting_.push_back(ping);
  if (waiting_.size() > most_waiting) {
    waiting_.pop_front();
  }
  if (!asked_) {
    asked_ = true;
    post([this] { take_pings(); });
  }
}

void Hub::on_world(const std::shared_ptr<const LiveWorld>& world) {
  post([this, world] {
    const bool new_scene = !world_ || !same_scene(*world_, *world);
    const bool same_levels =
        world_ && world_->sonars.size() == world->sonars.size() && world_->scenario.model == world->scenario.model;
    world_ = world;
    if (new_scene) {
      scene_ = scene_frame(*world);
    }
    if (!same_levels) {
      scales_.assign(world->sonars.size(), {});
    }
    last_pings_.assign(world->sonars.size(), nullptr);
    hello_ = nullptr;
    if (same_levels) {
      greet();
    }
  });
}

void Hub::on_note(const std::string& text) {
  complain(text);
  post([this, text] { send_note(text); });
}

void Hub::on_recorded(const LiveRecording& recording) {
  std::string text = recorded_text(recording);
  if (recording.pings > 0) {
    text += markers_.write_beside(recording.scenario);
  }
  if (!quiet_) {
    say("{}\n", text);
    flush_output();
  }
  post([this, text] { send_note(text); });
}

void Hub::send_note(const std::string& text) {
  for (HubMember* member : members_) {
    member->on_note(text);
  }
}

void Hub::take_pings() {
  std::deque<std::shared_ptr<const LivePing>> taken;
  {
    const std::lock_guard lock(mutex_);
    taken.swap(waiting_);
    asked_ = false;
  }
  for (const std::shared_ptr<const LivePing>& ping : taken) {
    if (ping->world != world_) {
      continue;  // Last ping of the previous world.
    }
    ++pings_;
    computing_time_ += ping->computing_time;
    const auto shared = std::make_shared<SharedPing>(ping);
    const auto sonar = static_cast<std::size_t>(ping->sonar);
    last_pings_[sonar] = shared;
    const bool other_levels = scales_[sonar].add(*ping);
    if (!hello_) {
      greet();
    } else if (other_levels) {
      send_levels(sonar);
    }
    for (HubMember* member : std::set<HubMember*>(members_)) {
      member->on_ping(*shared);
    }
  }
  send_position();
}

// Sends a recording's position, also to clients whose sonar has no ping there.
void Hub::send_position() {
  constexpr std::chrono::milliseconds kBetween(100);
  const auto now = std::chrono::steady_clock::now();
  if (source_.playback() != nullptr && (source_.state().paused || now - sent_position_at_ > kBetween)) {
    sent_position_at_ = now;
    send_state();
  }
}

// Only once the levels of all sonars are known, from their first pings.
bool Hub::make_hello() {
  std::vector<ShownLevels> levels;
  for (const ShownScale& scale : scales_) {
    if (!scale.levels()) {
      return false;
    }
    levels.push_back(*scale.levels());
  }
  hello_ = std::make_shared<const std::string>(hello_text(*world_, levels, source_.playback()));
  return true;
}

void Hub::greet() {
  if (!make_hello()) {
    return;
  }
  for (HubMember* member : std::set<HubMember*>(members_)) {
    member->on_world();
  }
}

void Hub::send_levels(std::size_t sonar) {
  (void)make_hello();  // For later clients.
  const Bytes text =
      std::make_shared<const std::string>(levels_text(world_->sonars[sonar].name, *scales_[sonar].levels()));
  for (HubMember* member : std::set<HubMember*>(members_)) {
    member->on_levels(text);
  }
}

void Hub::send_markers() {
  const Bytes text = std::make_shared<const std::string>(markers_.text());
  for (HubMember* member : std::set<HubMember*>(members_)) {
    member->on_markers(text);
  }
}

void Hub::leave(HubMember& member) {
  members_.erase(&member);
  if (LiveLoop* const simulation = source_.simulation(); simulation != nullptr && member.flies()) {
    simulation->fly({});
  }
}

void Hub::send_state() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - counted_at_).count();
  if (seconds > 0.9) {
    const auto count = static_cast<double>(pings_ - counted_pings_);
    counts_.pings_per_second = count / seconds;
    counts_.ms_per_ping = count > 0 ? 1000 * computing_time_ / count : counts_.ms_per_ping;
    counted_pings_ = pings_;
    computing_time_ = 0;
    counted_at_ = now;
  }
  for (HubMember* member : std::set<HubMember*>(members_)) {
    member->on_state();
  }
}

void Hub::send_state_soon() {
  if (!telling_.exchange(true)) {
    post([this] {
      telling_ = false;
      send_state();
    });
  }
}

std::filesystem::path Hub::recording_path(const std::string& ending) {
  const std::filesystem::path stem = recording_.parent_path() / recording_.stem();
  for (int number = 1;; ++number) {
    std::filesystem::path path = stem.string() + (number == 1 ? "" : fmt::format("_{}", number)) + ending;
    const std::vector<std::filesystem::path> files = live_recording_files(path, world_->sonars);
    if (std::ranges::none_of(files, [](const auto& file) { return std::filesystem::exists(file); })) {
      return path;
    }
  }
}

}  // namespace insonify
