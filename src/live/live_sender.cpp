// live_sender.cpp -- queues pings, up to a limit, and encodes and sends their messages.

#include "insonify/live_sender.h"

#include <chrono>
#include <iterator>
#include <limits>
#include <utility>

#include "insonify/error.h"

namespace insonify {
namespace {

double unix_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

LiveSender::LiveSender(const std::filesystem::path& scenario, const std::vector<std::string>& settings,
                       LiveSenderOptions options, Transport& transport, const Log& log)
    : options_(std::move(options)), transport_(transport) {
  options_.messages.validate();
  loop_ = std::make_unique<LiveLoop>(scenario, settings, options_.live, log);
}

LiveSender::~LiveSender() {
  try {
    end();
  } catch (const Error&) {
    return;  // As the destructor of a LiveLoop.
  }
}

void LiveSender::start() {
  translating_ = std::thread([this] { translate(); });
  loop_->start(*this);
}

void LiveSender::end() {
  if (!translating_.joinable()) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  loop_->end();
  translating_.join();
  answer_all();
}

void LiveSender::set_gain(std::size_t sonar, double gain_db) {
  const std::lock_guard lock(mutex_);
  gains_db_[sonar] = gain_db;
  gains_changed_ = true;
}

// The clock of the pings [s]: another program's, or the time since some moment.
double LiveSender::now() const {
  return options_.live.clocked
             ? clock_
             : std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Number of pings that can be sent now.
std::size_t LiveSender::due() const {
  return static_cast<std::size_t>(std::distance(waiting_.begin(), waiting_.upper_bound(now())));
}

void LiveSender::on_ping(const std::shared_ptr<const LivePing>& ping) {
  const SonarConfig& sonar = ping->world->sonars[static_cast<std::size_t>(ping->sonar)];
  const double travel = options_.at_once ? 0 : 2 * sonar.max_range / *sonar.assumed_sound_speed;
  std::unique_lock lock(mutex_);
  if (const auto asked = asked_.find(ping->request); asked != asked_.end() && asked->second.sonar == ping->sonar) {
    asked->second.made = true;
  }
  if (options_.lossless) {
    changed_.wait(lock, [this] { return ending_ || due() < kMostWaiting; });
  }
  const double transmitted = options_.live.clocked ? ping->clock : now() - ping->computing_time;
  waiting_.emplace(transmitted + travel, ping);
  if (!options_.lossless && due() > kMostWaiting) {
    waiting_.erase(waiting_.begin());
    ++dropped_;
  }
  changed_.notify_all();
}

// Makes all pings due, in their order.
void LiveSender::release_all() {
  for (const auto& [due, ping] : std::exchange(waiting_, {})) {
    waiting_.emplace(-std::numeric_limits<double>::infinity(), ping);
  }
}

void LiveSender::on_world(const std::shared_ptr<const LiveWorld>& world) {
  std::unique_lock lock(mutex_);
  release_all();  // Pings of the world before are sent first.
  opened_ = world;
  opening_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return ending_ || !opening_; });
}

void LiveSender::on_clock(double time) {
  const std::lock_guard lock(mutex_);
  if (time < clock_) {
    release_all();
  }
  clock_ = time;
  changed_.notify_all();
}

void LiveSender::on_idle() {
  options_.on_idle();
}

void LiveSender::on_note(const std::string& text) {
  options_.on_note(text);
}

// A failing transport fails at every ping: repeated problems are reported once.
void LiveSender::note_once(const std::string& problem) {
  if (problem != last_problem_) {
    on_note(problem);
    last_problem_ = problem;
  }
}

void LiveSender::wait_for_work(std::unique_lock<std::mutex>& lock) {
  while (!ending_ && !(opened_ && waiting_.empty()) && (waiting_.empty() || waiting_.begin()->first > now())) {
    if (waiting_.empty() || options_.live.clocked) {
      changed_.wait(lock);
    } else {
      changed_.wait_for(lock, std::chrono::duration<double>(waiting_.begin()->first - now()));
    }
  }
}

void LiveSender::translate() {
  std::unique_lock lock(mutex_);
  while (true) {
    wait_for_work(lock);
    for (; dropped_ > 0; --dropped_) {
      options_.on_dropped();
    }
    if (ending_) {
      return;
    }
    std::shared_ptr<const LivePing> ping;
    std::shared_ptr<const LiveWorld> world;
    if (waiting_.empty()) {
      world = std::move(opened_);
      opened_.reset();
    } else {
      ping = std::move(waiting_.extract(waiting_.begin()).mapped());
      changed_.notify_all();  // There is room again.
    }
    if (gains_changed_) {
      gains_changed_ = false;
      applied_gains_db_ = gains_db_;
      world_.reset();
    }
    lock.unlock();
    try {
      if (ping) {
        send(*ping);
      } else if (!world_ || world_->change < world->change) {
        open(*world);
        world_ = world;
        send_latched(static_cast<std::uint64_t>(unix_time() * 1e9));
      }
    } catch (const std::exception& error) {
      note_once(error.what());
      if (ping && is_asked(*ping)) {
        answer(ping->request, {}, error.what());
      }
    }
    lock.lock();
    if (world) {
      opening_ = opened_ != nullptr;
      changed_.notify_all();
    }
  }
}

}  // namespace insonify
