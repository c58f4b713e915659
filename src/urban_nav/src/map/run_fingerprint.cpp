// SPDX-License-Identifier: BSD-3-Clause
#include "map/run_fingerprint.hpp"

#include <link.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/command_parameters.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_store::appendInteger;
using urban_nav_store::appendText;
using urban_nav_store::sha256;

namespace {

constexpr std::streamoff kPiece = 1 << 16;  // bytes of a beginning and of an end
constexpr std::size_t kSampledFiles = 16;   // files of a folder
constexpr int kDeepest = 4;                 // nesting of folders: inputs have no more, and links may be cyclic

struct InputFile {
  std::string name;  ///< relative to the folder; of a bag: its name
  std::string path;
  std::uintmax_t size = 0;
  std::int64_t changed = 0;
};

/// Returns whether a file is ground truth, which does not affect estimates and is ignored by the fingerprint.
bool isTruth(const fs::path& path) {
  const std::string name = path.filename().string();
  return name == "poses.txt" || name == "state_groundtruth_estimate0";
}

InputFile describeFile(const fs::path& path, const std::string& name) {
  std::error_code error;
  InputFile file{name, path.string(), fs::file_size(path, error), 0};
  if (error) file.size = 0;
  file.changed = static_cast<std::int64_t>(fs::last_write_time(path, error).time_since_epoch().count());
  return file;
}

/// Returns the files of an input, sorted by name, without those that this run writes.
std::vector<InputFile> listFiles(const std::string& input, const std::string& out) {
  std::vector<InputFile> files;
  const fs::path root(input);
  if (!fs::is_directory(root)) return {describeFile(root, root.filename().string())};
  std::error_code ignored;
  const fs::path written = fs::weakly_canonical(out, ignored);
  const auto options = fs::directory_options::follow_directory_symlink | fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(root, options, ignored), end; entry != end; entry.increment(ignored)) {
    if (entry.depth() >= kDeepest) entry.disable_recursion_pending();
    if (isTruth(entry->path()) || fs::weakly_canonical(entry->path(), ignored) == written) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file(ignored)) {
      files.push_back(describeFile(entry->path(), entry->path().lexically_relative(root).generic_string()));
    }
  }
  std::sort(files.begin(), files.end(), [](const InputFile& a, const InputFile& b) { return a.name < b.name; });
  return files;
}

std::string firstAndLastBytes(const InputFile& file) {
  std::ifstream stream(file.path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(kPiece), '\0');
  stream.read(bytes.data(), kPiece);
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  const auto size = static_cast<std::streamoff>(file.size);
  if (size > kPiece && stream) {
    std::string end(static_cast<std::size_t>(kPiece), '\0');
    stream.seekg(std::max(kPiece, size - kPiece));
    stream.read(end.data(), kPiece);
    bytes.append(end, 0, static_cast<std::size_t>(stream.gcount()));
  }
  return bytes;
}

std::string computeDigest(const std::vector<std::string>& inputs, const std::string& out, bool with_time) {
  std::string bytes;
  for (const std::string& input : inputs) {
    const std::vector<InputFile> files = listFiles(input, out);
    const std::size_t step = std::max<std::size_t>(1, files.size() / kSampledFiles);
    appendInteger(bytes, files.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (fs::is_directory(input)) appendText(bytes, files[i].name);  // a bag may be renamed
      appendInteger(bytes, files[i].size);
      if (with_time) appendInteger(bytes, static_cast<std::uint64_t>(files[i].changed));
      if (i % step == 0) appendText(bytes, firstAndLastBytes(files[i]));
    }
  }
  return sha256(bytes);
}

int addObject(dl_phdr_info* object, std::size_t, void* bytes) {
  const std::string path = object->dlpi_name[0] == '\0' ? "/proc/self/exe" : object->dlpi_name;
  std::error_code error;
  if (!fs::exists(path, error)) return 0;  // of the kernel, such as the vdso
  const InputFile file = describeFile(fs::canonical(path, error), "");
  appendText(*static_cast<std::string*>(bytes), file.path);
  appendInteger(*static_cast<std::string*>(bytes), file.size);
  appendInteger(*static_cast<std::string*>(bytes), static_cast<std::uint64_t>(file.changed));
  return 0;
}

/// Returns a digest of the program and the libraries loaded at the first call; OpenCV and TBB load others later.
const std::string& digestOfProgram() {
  static const std::string digest = [] {
    std::string bytes;
    dl_iterate_phdr(addObject, &bytes);
    return sha256(bytes);
  }();
  return digest;
}

std::string digestOfParameters(const MapOptions& options, const StageList& stages) {
  std::vector<urban_nav_core::Setting> settings = options.parameters.settings(commandTable().stage());
  const std::vector<urban_nav_core::Setting> of_input =
      options.parameters.settings(urban_nav_input::inputTable().stage());
  settings.insert(settings.end(), of_input.begin(), of_input.end());
  for (const Stage* stage : stages) {
    const std::vector<urban_nav_core::Setting> used = stage->passSettings(options.parameters);
    settings.insert(settings.end(), used.begin(), used.end());
  }
  std::string bytes;
  for (const urban_nav_core::Setting& setting : settings) {
    if (setting.name == "memory_mb") continue;  // no result depends on it
    appendText(bytes, urban_nav_core::fullName(setting.stage, setting.name));
    appendText(bytes, urban_nav_core::printValue(setting.value));
  }
  return sha256(bytes);
}

std::string digestOfOptions(const MapOptions& options, const StageList& stages) {
  std::string bytes;
  for (const std::string& topic : options.source.topics) appendText(bytes, topic);
  urban_nav_store::appendNumber(bytes, options.source.rate);
  if (options.odometry != OdometryOption::Auto) appendInteger(bytes, static_cast<std::uint64_t>(options.odometry));
  for (const Stage* stage : stages)
    if (!stage->passSettings(options.parameters).empty()) appendText(bytes, stage->describe().key);
  std::string calibration = options.source.calibration;
  appendText(bytes, calibration);
  for (std::size_t comma = 0; !calibration.empty();
       calibration.erase(0, comma == std::string::npos ? comma : comma + 1)) {
    comma = calibration.find(',');
    appendText(bytes, computeDigest({calibration.substr(0, comma)}, options.out, true));
  }
  return sha256(bytes);
}

std::string digestOfStages(const MapOptions& options) {
  std::string bytes;
  for (const std::string& stage : options.stages) appendText(bytes, stage);
  return sha256(bytes);
}

std::string digestOfStore(const MapOptions& options) {
  std::error_code ignored;
  const bool own = fs::equivalent(options.store, fs::path(options.out) / "session.db", ignored);
  return options.store.empty() || own ? sha256("") : computeDigest({options.store}, options.out, true);
}

}  // namespace

namespace {

/// Appends to a digest the part of the bags that a session consists of, if not all of them.
std::string appendPart(std::string digest, const urban_nav_input::ReceiptRange& part) {
  if (part == urban_nav_input::ReceiptRange{}) return digest;
  return digest + ":" + std::to_string(part.begin) + "-" + std::to_string(part.end);
}

}  // namespace

RunFingerprint fingerprint(const MapOptions& options, const StageList& stages,
                           const urban_nav_input::InputSession& session) {
  return {{"inputs", appendPart(computeDigest(session.paths, options.out, true), session.part)},
          {"options", digestOfOptions(options, stages)},
          {"parameters", digestOfParameters(options, stages)},
          {"program", digestOfProgram()},
          {"stages", digestOfStages(options)},
          {"store", digestOfStore(options)}};
}

urban_nav_store::SessionOrigin origin(const MapOptions& options, const urban_nav_input::InputSession& session) {
  return {"", "", 0, appendPart(computeDigest({session.paths.front()}, options.out, false), session.part)};
}

std::vector<std::string> bagFingerprints(const MapOptions& options, const urban_nav_input::InputSession& session) {
  std::vector<std::string> digests;
  if (session.begin != 0)
    for (const std::string& path : session.paths)
      digests.push_back(appendPart(computeDigest({path}, options.out, true), session.part));
  return digests;
}

std::string differences(const RunFingerprint& a, const RunFingerprint& b, const std::vector<std::string>& but) {
  std::string names;
  for (const auto& [name, digest] : a) {
    if (std::find(but.begin(), but.end(), name) != but.end()) continue;
    const auto other =
        std::find_if(b.begin(), b.end(), [&, name = name](const auto& each) { return each.first == name; });
    if (other == b.end() || other->second != digest) names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

}  // namespace urban_nav
