// export_video.cpp -- draws each ping and hands the pictures to ffmpeg.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "insonify/error.h"
#include "io/export/export_format.h"
#include "io/export/ffmpeg.h"
#include "io/file/unfinished_file.h"

namespace insonify {
namespace {

constexpr double kMostPictures = 50;  // Per second.

void check(const VideoOptions& video) {
  if (video.rate && !(*video.rate > 0 && *video.rate <= 120)) {
    throw Error("video", "rate", fmt::format(" = {:.6g} must be greater than 0, at most 120", *video.rate));
  }
  if (video.low_db.has_value() != video.high_db.has_value() || (video.low_db && !(*video.low_db < *video.high_db))) {
    throw Error("video", "low_db", " and high_db must be two rising levels [dB], or both absent");
  }
}

double usual_rate(const RecordedPings& pings, std::uint64_t count) {
  if (count < 2) {
    return 1;
  }
  const double seconds = pings.ping(count - 1).time - pings.ping(0).time;
  return seconds > 0 ? std::min(kMostPictures, static_cast<double>(count - 1) / seconds) : 1;
}

// Draws one ping after the other, as `insonify run` draws them: a fan, or what a scanning sonar has seen so far.
class Drawing {
 public:
  Drawing(const MessageSource& source, const VideoOptions& video)
      : sonar_(source.sonar), display_(usual_display(source.model, source.receiver)), view_(sonar_) {
    display_.colour_map = video.colour_map;
    display_.height = video.height;
    display_.annotations = video.annotations;
    fitted_ = source.model == EchoModel::kCalibrated && !video.low_db;
    if (video.low_db) {
      display_.scale = Scale::kDecibel;
      display_.of_one = source.model == EchoModel::kPaper;
      display_.full_scale = std::pow(10, *video.high_db / 10);
      display_.floor_db = *video.low_db - *video.high_db;
    }
    display_.validate();
  }

  void fit(const RecordedPings& pings, std::uint64_t count, const ExportOptions& options) {
    if (!fitted_) {
      return;
    }
    ProductView all(sonar_);
    const std::uint64_t fitted = sonar_.product() == Product::kLine ? count : 1;  // The first ping of a fan.
    for (std::uint64_t i = 0; i < fitted; ++i) {
      check_stop(options);
      all.add(shown(pings.ping(i)));
    }
    display_.full_scale = all.fitting_full_scale();
  }

  Picture draw(const Ping& ping) {
    view_.add(shown(ping));
    return view_.draw(display_);
  }

 private:
  [[nodiscard]] Ping shown(const Ping& ping) const { return raised_by_range(ping, sonar_, display_.raised_per_decade); }

  SonarConfig sonar_;
  Display display_;
  bool fitted_ = false;
  ProductView view_;
};

}  // namespace

void export_video(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  const RecordedTables& recording = *recordings.front();
  check(options.video);
  const RecordedPings pings = pings_of(recording);
  const std::uint64_t count = recording.ping_count();
  Drawing drawing(message_source(recording), options.video);
  drawing.fit(pings, count, options);
  const double rate = options.video.rate.value_or(usual_rate(pings, count));
  UnfinishedFile out(file, "cannot create");
  const Picture picture = drawing.draw(pings.ping(0));
  Ffmpeg ffmpeg(file, out.unfinished(), picture.width, picture.height, rate);
  try {
    ffmpeg.add(picture);
    for (std::uint64_t i = 1; i < count; ++i) {
      check_stop(options);
      ffmpeg.add(drawing.draw(pings.ping(i)));
    }
    ffmpeg.finish();
  } catch (const Error&) {
    check_stop(options);  // Ctrl-C reaches ffmpeg too, which then ends.
    throw;
  }
  out.put_in_place();
}

}  // namespace insonify
