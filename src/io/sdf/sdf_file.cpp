// sdf_file.cpp -- reads a file by libsdformat, without its joints if need be; makes one message about the cause of a
// list of errors.

#include "io/sdf/sdf_file.h"

#include <fmt/format.h>

#include <exception>
#include <sdf/Console.hh>
#include <sdf/parser.hh>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/error.h"
#include "io/file/input_file.h"
#include "io/sdf/sdf_console.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

// The file that a model.config lists for the newest known version; an empty path if it is malformed.
fs::path listed_file(const fs::path& folder) {
  const SdfConsole quiet;
  try {
    return sdf::getModelFilePath(folder.string());
  } catch (const std::exception&) {  // Thrown for a version that is not a number.
    return {};
  }
}

// Errors that only repeat the cause for each element around the faulty one.
bool is_echo(const sdf::Error& error) {
  const std::string text = error.Message();
  return text.starts_with("Error reading element <") || text.starts_with("Unable to read file") ||
         text.starts_with("Failed to load a world");
}

// "/sdf/model[@name="ship"]/link[@name="hull"]" gives "link".
std::string element_of(const std::string& xml_path) {
  const std::string last = xml_path.substr(xml_path.rfind('/') + 1);
  return last.substr(0, last.find('['));
}

// Names that errors without a line give in brackets, without scopes: "link with name[ship::hull]" gives "hull".
std::vector<std::string> names_in(const sdf::Error& error) {
  std::vector<std::string> names;
  const std::string text = error.Message();
  for (std::size_t open = text.find('['); open != std::string::npos; open = text.find('[', open + 1)) {
    const std::string scoped = text.substr(open + 1, text.find(']', open) - open - 1);
    const std::size_t colons = scoped.rfind("::");
    names.push_back(colons == std::string::npos ? scoped : scoped.substr(colons + 2));
  }
  return names;
}

// One line for all errors, as the fault of an element where libsdformat names its line. If libsdformat says only which
// element it could not read, the reason is on the console.
SdfFault summary(const sdf::Errors& errors, const std::vector<std::string>& console, const std::string& file,
                 const SdfSource& source) {
  const sdf::Error* cause = &errors.front();
  std::set<std::string> causes;
  for (const sdf::Error& error : errors) {
    if (!is_echo(error)) {
      cause = causes.empty() ? &error : cause;
      causes.insert(error.Message());
    }
  }
  const bool silent = causes.empty() && !console.empty();
  const std::string text = foreign_reason(source.with_users_places(silent ? console.front() : cause->Message()));
  const std::size_t more = causes.size() > 1 ? causes.size() - 1 : 0;
  const std::string whole =
      more == 0 ? text : fmt::format("{} (and {} more error{})", text, more, more == 1 ? "" : "s");
  const std::string path = cause->FilePath().value_or(file);
  return cause->LineNumber()
             ? source.fault(whole, path, *cause->LineNumber(), element_of(cause->XmlPath().value_or("")))
             : source.fault(whole, path, names_in(*cause));
}

// libsdformat does not pass on errors inside included files: they are found by reading each file again.
void explain_failure(const sdf::Errors& errors, const std::vector<std::string>& console, const SdfSource& source,
                     const std::string& portion) {
  std::vector<std::string> files = source.includes();
  files.push_back(portion);
  for (const std::string& file : files) {
    const SdfConsole quiet;
    sdf::Errors faults;
    if (sdf::readFile(file, faults) == nullptr || !faults.empty()) {
      throw summary(faults.empty() ? errors : faults, quiet.sentences(), file, source);
    }
  }
  throw summary(errors, console, portion, source);
}

// For some faulty values libsdformat throws exceptions of the standard library.
sdf::Errors load(const SdfSource& source, const std::string& file, sdf::Root& root) {
  try {
    return root.Load(file);
  } catch (const std::exception& exception) {
    throw Error(fmt::format("{}: libsdformat gives up: {}", source.shown(file), foreign_reason(exception.what())));
  }
}

// Parses a portion that `source` prepared; errors become one line, warnings go to the log. Nothing is printed.
// @throws Error "path:line:column: ..." for the first fault; the message ends with the number of further ones.
sdf::Root read_sdf_root(const SdfSource& source, const std::string& portion, const Log& log) {
  const SdfConsole console;
  sdf::Root root;
  const sdf::Errors errors = load(source, portion, root);
  if (!errors.empty()) {
    explain_failure(errors, console.sentences(), source, portion);
  }
  for (const std::string& sentence : console.sentences()) {
    if (!sentence.starts_with("Unable to convert from SDF version")) {  // SdfSource warns of that, with file and line.
      log_line(log, Severity::kWarning,
               fmt::format("{}: {}", source.shown(portion), foreign_reason(source.with_users_places(sentence))));
    }
  }
  return root;
}

// Nothing if the file must be read as a whole.
std::optional<SdfModels> parse(const std::filesystem::path& path, const SdfReading& reading,
                               const std::set<std::string>& without, MissingParts& missing, const Log& log) {
  const SdfSource source(path, reading, without, missing, log);
  if (reading.strict) {
    missing.report(path.string(), reading.strict, log);
  }
  if (MeshReadAhead* const ahead = MeshReadAhead::current()) {
    source.want_meshes(*ahead);
  }
  SdfModels models;
  try {
    for (const std::string& portion : source.portions()) {
      models.add(source, read_sdf_root(source, portion, log));
    }
  } catch (const SdfFault&) {
    throw;
  } catch (const Error& error) {
    throw missing.empty() ? error
                          : Error(fmt::format("{}; missing parts may be the cause: {}", error.what(), missing.text()));
  }
  return models.add_twins(source.twins()) ? std::optional(std::move(models)) : std::nullopt;
}

}  // namespace

std::optional<fs::path> sdf_file_of_model(const fs::path& found) {
  if (!fs::is_directory(found)) {
    return found;
  }
  const bool is_listed = fs::exists(found / "model.config") || fs::exists(found / "manifest.xml");
  const fs::path file = is_listed ? listed_file(found) : found / "model.sdf";
  return fs::is_regular_file(file) ? std::optional(file.lexically_normal()) : std::nullopt;
}

std::unique_lock<std::mutex> lock_sdf() {
  static std::mutex one_at_a_time;
  return std::unique_lock(one_at_a_time);
}

// If the file cannot be read, it is read again without the element that is at fault; if none is known, or there are too
// many of them, without its joints, which have no shape.
SdfModels read_sdf_models(const std::filesystem::path& path, SdfReading reading, MissingParts& missing,
                          const Log& log) {
  constexpr std::size_t kMostFaults = 100;
  std::set<std::string> without;
  std::vector<std::string> faults;
  for (;;) {
    std::vector<std::pair<Severity, std::string>> said;
    const Log keep = [&](Severity severity, const std::string& line) { said.emplace_back(severity, line); };
    const auto flush_warnings = [&] {
      for (const auto& [severity, line] : said) {
        log_line(log, severity, line);
      }
    };
    MissingParts found;
    try {
      std::optional<SdfModels> models = parse(path, reading, without, found, keep);
      if (!models) {
        reading.whole = true;
        continue;
      }
      flush_warnings();
      for (const std::string& fault : faults) {
        found.add(fault, "");
      }
      missing = found;
      return std::move(*models);
    } catch (const Error& error) {
      const auto* fault = dynamic_cast<const SdfFault*>(&error);
      const bool is_known = fault != nullptr && !fault->place_to_leave_out.empty() && faults.size() < kMostFaults &&
                            without.insert(fault->place_to_leave_out).second;
      if (reading.strict || (!is_known && !reading.joints)) {
        flush_warnings();
        throw;
      }
      faults.push_back(is_known ? error.what()
                                : fmt::format("the joints, which have no shapes, for a fault: {}", error.what()));
      reading.joints = reading.joints && is_known;
    }
  }
}

}  // namespace insonify
