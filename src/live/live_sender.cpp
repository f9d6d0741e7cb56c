// live_sender.cpp -- queues pings, up to a limit, and encodes and sends their messages.

#include "insonify/live_sender.h"

#include <algorithm>
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

// A Unix time by the steady clock.
std::chrono::steady_clock::time_point steady_time(double unix) {
  return std::chrono::steady_clock::now() - std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                std::chrono::duration<double>(unix_time() - unix));
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
  for (const auto& [request, asked] : std::exchange(asked_, {})) {
    asked.answer({}, "the simulation ends");
  }
}

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

MessageOptions LiveSender::options_of(const MessageSource& source, std::size_t sonar) const {
  MessageOptions options = options_.messages;
  const auto gain = applied_gains_db_.find(sonar);
  const MessageLevels levels = SonarMessages(source, options, options_.form).levels();
  if (gain != applied_gains_db_.end() && levels.decibels) {
    options.low_db = levels.low_db - gain->second;
    options.high_db = levels.high_db - gain->second;
  }
  return options;
}

void LiveSender::open(const LiveWorld& world) {
  sent_latched_ = false;
  messages_.clear();
  transport_.begin(world);
  std::vector<std::string> labels;
  for (const Instance& instance : world.scene.instances) {
    labels.push_back(instance.name);
  }
  for (const SonarConfig& sonar : world.sonars) {
    MessageSource source = message_source(world.scenario, sonar);
    source.labels = labels;
    messages_.emplace_back(source, options_of(source, messages_.size()), options_.form);
    transport_.open(messages_.size() - 1, messages_.back().channels());
  }
}

// The scenario's text and the mountings of all sonars are one message each.
void LiveSender::send_latched(std::uint64_t time_ns) {
  for (std::size_t sonar = 0; sonar < messages_.size() && !sent_latched_; ++sonar) {
    const std::vector<MessageChannel>& channels = messages_[sonar].channels();
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
      const MessageKind kind = channels[channel].kind;
      if (channels[channel].latched && (sonar == 0 || kind == MessageKind::kDescription)) {
        transport_.send(
            sonar, channel, time_ns,
            kind == MessageKind::kTransforms ? SonarMessages::mountings(messages_) : messages_[sonar].encode(channel));
      }
    }
  }
  sent_latched_ = true;
}

// A message has the stamp of the pose that its ping was made from. Further pings from the same pose are later by the
// interval between them. On the scenario's own trajectory, the stamp is the time of transmission. A stamp of 0 means
// "the latest" to readers of transforms: the first one of a clock that begins at 0 is 1 ns.
void LiveSender::send(const LivePing& live) {
  if (!world_ || live.world->change != world_->change) {
    open(*live.world);
    world_ = live.world;
  }
  const auto sonar = static_cast<std::size_t>(live.sonar);
  SonarMessages& messages = messages_[sonar];
  const double transmitted = live.made_at - live.computing_time;
  const bool told = live.received_at > 0;
  const bool new_pose = told && std::exchange(received_at_[live.sonar], live.received_at) != live.received_at;
  const double by_clock = options_.live.clocked ? std::max(live.clock, live.stamp)
                                                : transmitted + (told ? live.stamp - live.received_at : 0);
  constexpr double kEarliest = 1e-9;
  messages.take(live.ping, std::max(kEarliest, new_pose ? live.stamp : by_clock));
  send_latched(messages.time_ns());
  for (std::size_t channel = 0; channel < messages.channels().size(); ++channel) {
    const MessageChannel& is = messages.channels()[channel];
    if (!is.latched && transport_.is_read(sonar, channel) &&
        (is.kind != MessageKind::kScan || messages.is_due(channel))) {
      transport_.send(sonar, channel, messages.time_ns(), messages.encode(channel));
    }
  }
  if (is_asked(live)) {
    const auto image = std::ranges::find(messages.channels(), MessageKind::kSonarImage, &MessageChannel::kind);
    answer(live.request, messages.encode(static_cast<std::size_t>(image - messages.channels().begin())), "");
  }
  options_.on_sent(steady_time(new_pose ? live.received_at : transmitted), live.computing_time);
}

}  // namespace insonify
