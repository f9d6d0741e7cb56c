// bind_export.cpp -- insonify.export(): recordings in the formats of other tools.

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <future>

#include "bind.h"
#include "convert.h"
#include "insonify/export.h"
#include "interpreter_lock.h"
#include "python_recording.h"

namespace insonify::python {
namespace {

RecordingPart recording_part(py::handle given) {
  if (!py::isinstance<PythonRecording>(given)) {
    return {path_from(given, "recordings")};
  }
  const auto& recording = given.cast<const PythonRecording&>();
  return {recording.path, recording.pings.sonar()};
}

// One recording or a list of them.
std::vector<RecordingPart> recording_parts(const py::object& given) {
  if (!py::isinstance<py::list>(given) && !py::isinstance<py::tuple>(given)) {
    return {recording_part(given)};
  }
  std::vector<RecordingPart> parts;
  for (const py::handle& one : given) {
    parts.push_back(recording_part(one));
  }
  return parts;
}

void take_levels(py::handle value, ExportOptions& options) {
  if (value.is_none()) {
    return;
  }
  const auto [low, high] = levels_from(value);
  options.messages.low_db = options.video.low_db = low;
  options.messages.high_db = options.video.high_db = high;
}

// Text, or a datetime with its time zone.
void take_start(const py::object& value, ExportOptions& options) {
  options.messages.start_ns.reset();
  if (value.is_none()) {
    return;
  }
  std::string text;
  from_python(py::hasattr(value, "isoformat") ? py::object(value.attr("isoformat")()) : value, "start", 1, text);
  try {
    options.messages.start_ns = start_from_text(text);
  } catch (const Error& error) {
    throw Error("", "start", std::string(" = ") + error.what());
  }
}

// (latitude, longitude) in degrees.
void take_origin(py::handle value, ExportOptions& options) {
  options.origin.reset();
  if (value.is_none()) {
    return;
  }
  std::vector<double> both;
  from_python(value, "origin", 1, both);
  if (both.size() != 2) {
    throw Error("", "origin", " must be (latitude, longitude) in degrees");
  }
  options.origin = GeographicPoint{both[0], both[1]};
}

// A list of points, or None.
void take_profile(py::handle value, ExportOptions& options) {
  options.profile.clear();
  if (!value.is_none()) {
    options.profile = profile_points(py::reinterpret_borrow<py::object>(value), "profile");
    check_profile(options.profile, "profile");
  }
}

void take_option(const std::string& name, py::handle value, ExportOptions& options) {
  bool known = true;
  if (name == "replace") {
    from_python(value, name, 1, options.replace);
  } else if (name == "compress") {
    from_python(value, name, 1, options.compress);
  } else if (name == "levels") {
    take_levels(value, options);
  } else if (name == "start") {
    take_start(py::reinterpret_borrow<py::object>(value), options);
  } else if (name == "origin") {
    take_origin(value, options);
  } else if (name == "uncertainty") {
    from_python(value, name, 1, options.uncertainty);
  } else if (name == "profile") {
    take_profile(value, options);
  } else if (name == "rate") {
    from_python(value, name, 1, options.video.rate);
  } else if (name == "height") {
    from_python(value, name, 1, options.video.height);
  } else if (name == "colour_map" || name == "color_map") {
    std::string word;
    from_python(value, name, 1, word);
    options.messages.colour_map = options.video.colour_map = colour_map_from_name(word);
  } else {
    known = false;
  }
  if (name == "annotations") {
    from_python(value, name, 1, options.video.annotations);
  }
  for (const FieldEntry& field : table_of<MessageOptions>().fields) {
    if (field.name == name) {
      field.change(&options.messages, [&](auto& member) { from_python(value, name, 1, member); });
      known = true;
    }
  }
  if (!known) {
    throw py::type_error("export() has no option " + shown(py::str(name)));
  }
}

void export_all(const py::object& recordings, const py::object& file, const py::kwargs& given) {
  const std::vector<RecordingPart> parts = recording_parts(recordings);
  const std::filesystem::path to = path_from(file, "file");
  std::atomic<bool> stop = false;
  ExportOptions options;
  if (given.contains("colour_map") && given.contains("color_map")) {
    throw Error("", "colour_map", " is given twice: color_map is the same");
  }
  for (const auto& [name, value] : given) {
    take_option(name.cast<std::string>(), value, options);
  }
  options.stop = &stop;
  std::vector<std::string> warnings;
  options.log = [&](Severity severity, const std::string& message) {
    if (severity == Severity::kWarning) {
      warnings.push_back(message + "; levels=(low, high) changes that");
    }
  };
  // In another thread, so that this one can check for Control-C.
  std::future<void> done;
  {
    const Released released;
    done =
        std::async(std::launch::async, [&] { export_recordings(std::span<const RecordingPart>(parts), to, options); });
    constexpr std::chrono::milliseconds kLook(50);
    while (done.wait_for(kLook) != std::future_status::ready) {
      const Locked locked;
      if (PyErr_CheckSignals() != 0) {
        PyErr_Clear();  // Interrupted becomes KeyboardInterrupt.
        stop = true;
      }
    }
  }
  done.get();
  for (const std::string& text : warnings) {  // In this thread: raises one here if warnings are errors.
    warnings_log()(Severity::kWarning, text);
  }
}

}  // namespace

void bind_export(py::module_& module) {
  module.def(
      "export", &export_all, py::arg("recordings"), py::arg("file"),
      "export(recordings, file, **options)\n\nWrites recordings of one run, one per sonar, to a file in the format of "
      "its ending: .mcap (ROS 2 messages), .bag (of ROS 1), .npz, .zarr, .xtf and .jsf (side-scan sonars), .xyz, .gsf "
      "and .kmall (multibeams), .mp4 or .gif, as `insonify export`.\n\n"
      "recordings: a path or a RecordedPings, or a list of them; the path of an MCAP file includes all of its sonars. "
      "Options: replace (False: an error where the file is there). compress (True), of .npz. levels (low, high) in dB "
      "as on the colour bar, of videos, .mcap and .bag; None fits. colour_map (or color_map). annotations. rate, "
      "pictures a second, and height in pixels, 240 to 8192, of videos. bits (8 or 16), strong_share, fan_height in "
      "pixels, fan_rate (fan pictures a second at most, 0 for none; 2 for scanning sonars unless given), world_frame "
      "and start (the run's time 0, \"2026-06-01T10:00:00Z\" or a datetime with its time zone), of .mcap and .bag; "
      "start "
      "and origin (latitude and longitude of the world's origin in degrees), of .xtf, .jsf, .gsf and .kmall, origin of "
      ".xyz too. uncertainty (False), a column of .xyz. profile, a list of ProfilePoint or of pairs of depth and sound "
      "speed, as load_sound_speed_profile() gives: places soundings in .xyz, .gsf and .kmall along its rays; None: "
      "straight ones.\n\n"
      "Warns (insonify.Warning) of values above the highest level of .mcap and .bag, which are clipped. Raises Error "
      "with the path for an unknown extension, several sonars in a video, an existing file, a full disk, and and a "
      "video without ffmpeg; KeyboardInterrupt on Control-C, which leaves no file.");
}

}  // namespace insonify::python
