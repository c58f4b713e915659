// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "base/parameters.hpp"
#include "scene_labeler/class_map.hpp"
#include "scene_labeler/parameters.hpp"
#include "topics/labels/label_drive.hpp"
#include "topics/labels/label_model_file.hpp"
#include "topics/labels/label_score.hpp"
#include "topics/labels/label_sources.hpp"
#include "topics/labels/label_sweeps.hpp"
#include "topics/labels/label_teaching.hpp"
#include "topics/labels/labelled_cloud_files.hpp"
#include "topics/labels/labels_actions.hpp"
#include "topics/labels/teach/scene_teacher.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::ClassMap;

namespace {

constexpr double kLowestPrecision = 0.5, kHighestPrecision = 0.999;  // as of parameter precision

std::string labelsHelp(const Arguments& arguments) { return stageHelp(arguments, scene_labeler::table().stage()); }

void writeLabelImage(const cv::Mat& image, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  urban_nav_core::writeAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void warnOfNewPlace(const LabelRun& run, Console& console) {
  const std::string warning = scene_labeler::newPlaceWarning(run.new_place_frames, run.frames);
  if (!warning.empty()) console.warn(warning);
}

/// Files of the labels of one side laser.
class SideLabelFiles {
 public:
  /// `base`: path without extension.
  SideLabelFiles(const std::string& base, const LabelFormats& formats, const scene_labeler::LabelModel& model)
      : cloud_(base, formats, {false, true, true}) {
    if (!formats.csv) return;
    csv_.emplace(base + ".csv");
    csv_->write(printDriveHeader(model.classes));
  }
  void append(const std::vector<scene_labeler::DriveReturn>& returns, const scene_labeler::SceneLabels& labels) {
    if (csv_) csv_->write(printDriveLabels(returns, labels));
    appendDrive(returns, labels, cloud_);
  }
  void commit() {
    if (csv_) csv_->commit();
    cloud_.commit();
  }

 private:
  std::optional<urban_nav_core::AtomicFile> csv_;
  LabelledCloudFiles cloud_;
};

/// Files of the labels of the 3D LiDARs of a bag.
class SweepLabelFiles {
 public:
  SweepLabelFiles(std::filesystem::path folder, const LabelFormats& formats)
      : folder_(std::move(folder)), formats_(formats) {}

  void append(const std::string& role, const std::vector<urban_nav_core::LaserPoint>& returns,
              const scene_labeler::SweepLabels& labels) {
    OfLidar& files = files_[role];
    const std::string base = (folder_ / (role + "_labels")).string();
    if (!files.cloud) {
      files.cloud =
          std::make_unique<LabelledCloudFiles>(base, formats_, LabelledCloudFiles::Columns{false, true, true});
      if (formats_.csv) files.csv = std::make_unique<urban_nav_core::AtomicFile>(base + ".csv");
      if (files.csv) files.csv->write(printSweepHeader(labels.answers.classes));
    }
    if (files.csv) files.csv->write(printSweepLabels(returns, labels));
    appendSweep(returns, labels, *files.cloud);
  }
  void commit() {
    for (auto& [role, files] : files_) {
      if (files.csv) files.csv->commit();
      files.cloud->commit();
    }
  }

 private:
  struct OfLidar {
    std::unique_ptr<urban_nav_core::AtomicFile> csv;
    std::unique_ptr<LabelledCloudFiles> cloud;
  };
  const std::filesystem::path folder_;
  const LabelFormats formats_;
  std::map<std::string, OfLidar> files_;  // by role
};

/// Labels the sides of a bag into files, which appear when all are complete.
void applyToSides(const scene_labeler::LabelModel& model, const std::string& bag, const DriveOptions& options,
                  const std::filesystem::path& folder, const LabelFormats& formats, Console& console, LabelRun& run) {
  SideLabelFiles left((folder / "laser_left_labels").string(), formats, model),
      right((folder / "laser_right_labels").string(), formats, model);
  labelDrive(
      model, bag, options, console,
      [&](DriveSide side, const std::vector<scene_labeler::DriveReturn>& returns,
          const scene_labeler::SceneLabels& labels) {
        (side == DriveSide::Left ? left : right).append(returns, labels);
      },
      run);
  left.commit();
  right.commit();
}

/// Labels all lasers of a bag into files.
void applyToBag(const scene_labeler::LabelModel& model, const std::string& bag, const DriveOptions& options,
                const std::filesystem::path& folder, const LabelFormats& formats, Console& console, LabelRun& run) {
  std::filesystem::create_directories(folder);
  const LabelledSensors sensors = findLabelledSensors(bag, options.topics);
  if (sensors.has_sides || !sensors.has_lidars) applyToSides(model, bag, options, folder, formats, console, run);
  if (!sensors.has_lidars) return;
  SweepLabelFiles files(folder, formats);
  labelSweeps(
      model, bag, options, console,
      [&](const std::string& role, const std::vector<urban_nav_core::LaserPoint>& returns,
          const scene_labeler::SweepLabels& labels) { files.append(role, returns, labels); },
      run);
  files.commit();
}

/// Writes the files of a labelled scene.
void writeScene(const std::string& base, const LabelFormats& formats, const SceneInput& input,
                const scene_labeler::SceneLabels& labels, Console& console) {
  if (formats.csv) urban_nav_core::writeAtomically(base + ".csv", printSceneLabels(labels));
  const std::size_t left_out = writeSceneCloud(base, formats, input, labels);
  if (left_out > 0)
    console.warn(base + ".las: " + std::to_string(left_out) +
                 " points are left out, which are not finite or more than 200 km from the first one");
  if (!labels.image.empty()) writeLabelImage(labels.image, base + ".png");
}

scene_labeler::LabelModel readAppliedModel(const Arguments& arguments, const ParameterSet& parameters) {
  const double precision = arguments.number("precision", parameters.get(scene_labeler::table()).precision,
                                            kLowestPrecision, kHighestPrecision);
  return readLabelModel(arguments.get("MODEL"), precision).model;
}

/// Returns the model whose thresholds are in the results: that of bags if there are any.
const scene_labeler::LabelModel& reportedModel(const scene_labeler::LabelModel& model, const LabelSources& sources) {
  return sources.bags.empty() ? scene_labeler::modelFor(model, "") : model;
}

void warnOfThresholds(const scene_labeler::LabelModel& model, const std::string& name, Console& console) {
  const std::string note = scene_labeler::thresholdNote(model.sure, model.precision, name);
  if (!note.empty()) console.warn(note);
}

/// Corrections of --corrections, by which the model is taught before it is applied.
std::optional<SceneCorrections> applyCorrections(const Arguments& arguments, const ParameterSet& parameters,
                                                 Console& console, scene_labeler::LabelModel& model) {
  if (!arguments.has("corrections")) return std::nullopt;
  const scene_labeler::Parameters& labeler = parameters.get(scene_labeler::table());
  CorrectionTraining training;
  training.superpixel = labeler.superpixel;
  training.samples_per_class = static_cast<std::size_t>(labeler.samples);
  SceneCorrections corrections = readSceneCorrections(arguments.get("corrections"), ClassMap(), console);
  model = teachByCorrections(model, arguments.get("MODEL"), corrections, training);
  return corrections;
}

int runLabelsApply(const OdometryRunner& run_odometry, const Arguments& arguments, Console& console) {
  const ParameterSet parameters = loadParameters(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  scene_labeler::LabelModel model = readAppliedModel(arguments, parameters);
  const std::optional<SceneCorrections> corrections = applyCorrections(arguments, parameters, console, model);
  const LabelFormats formats = readLabelFormats(arguments);
  const LabelSources sources = findLabelSources(arguments, parameters, run_odometry);
  warnOfThresholds(reportedModel(model, sources), arguments.get("MODEL"), console);
  const std::vector<SceneFiles>& scenes = sources.scenes;
  for (std::size_t i = 1; i < scenes.size(); ++i)
    if (scenes[i].name == scenes[i - 1].name)
      throw urban_nav_core::UserError(scenes[i].points, "has the name of " + scenes[i - 1].points,
                                      "one scene of each name, since DIR holds NAME_labels.csv");
  const std::filesystem::path folder(arguments.get("output"));
  std::filesystem::create_directories(folder);
  LabelRun run;
  for (std::size_t i = 0; i < sources.bags.size(); ++i)
    applyToBag(model, sources.bags[i], sources.drives[i],
               sources.bags.size() == 1 ? folder : folder / std::filesystem::path(sources.bags[i]).stem(), formats,
               console, run);
  labelScenes(
      model, scenes, parameters.get(scene_labeler::table()).superpixel, console,
      [&](std::size_t i, const SceneInput& input, scene_labeler::SceneLabels& labels) {
        if (corrections && corrections->describes(input)) keepCorrections(corrections->labels, labels);
        writeScene((folder / (scenes[i].name + "_labels")).string(), formats, input, labels, console);
      },
      run);
  console.info(std::to_string(run.labelled) + " of " + std::to_string(run.points) + " points in " +
               std::to_string(run.frames) + " scenes are labelled, " + std::to_string(run.unsure) + " of them unsure" +
               (run.has_look ? "" : "; without images: by shape only"));
  warnOfNewPlace(run, console);
  if (arguments.has("json"))
    urban_nav_core::writeAtomically(arguments.get("json"), run.toJson(reportedModel(model, sources)).print());
  return 0;
}

/// Truth of the sources, read before anything is labelled.
struct SourceTruth {
  std::vector<std::array<DriveTruth, 2>> drives;
  std::vector<std::vector<scene_labeler::SceneClass>> scenes;
};

SourceTruth readSourceTruth(const LabelSources& sources, const ClassMap& map) {
  SourceTruth truth;
  for (const std::string& bag : sources.bags)
    truth.drives.push_back({DriveTruth(DriveTruth::path(bag, DriveSide::Left), map),
                            DriveTruth(DriveTruth::path(bag, DriveSide::Right), map)});
  for (const SceneFiles& files : sources.scenes)
    truth.scenes.push_back(map.toClasses(readSceneLabels(files, !map.isOwnNumbers()), files.points));
  return truth;
}

/// Returns whether the model or a scene does not distinguish kinds of wall.
bool hasOneWall(const scene_labeler::LabelModel& model, const SourceTruth& truth) {
  const auto holds = [](const std::vector<scene_labeler::SceneClass>& classes) {
    return std::find(classes.begin(), classes.end(), scene_labeler::SceneClass::Wall) != classes.end();
  };
  const bool has_scenes = !truth.scenes.empty();
  return holds(model.classes) || (has_scenes && holds(scene_labeler::modelFor(model, "").classes)) ||
         std::any_of(truth.scenes.begin(), truth.scenes.end(), holds);
}

int runLabelsEvaluate(const OdometryRunner& run_odometry, const Arguments& arguments, Console& console) {
  const ParameterSet parameters = loadParameters(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const scene_labeler::LabelModel model = readAppliedModel(arguments, parameters);
  const ClassMap map = readClassMap(arguments);
  const LabelSources sources = findLabelSources(arguments, parameters, run_odometry);
  warnOfThresholds(reportedModel(model, sources), arguments.get("MODEL"), console);
  const SourceTruth truth = readSourceTruth(sources, map);
  LabelScore score(hasOneWall(model, truth));
  LabelRun run;
  for (std::size_t i = 0; i < sources.bags.size(); ++i)
    labelDrive(
        model, sources.bags[i], sources.drives[i], console,
        [&](DriveSide side, const std::vector<scene_labeler::DriveReturn>& returns,
            const scene_labeler::SceneLabels& labels) {
          std::vector<scene_labeler::SceneClass> expected;
          for (const scene_labeler::DriveReturn& one : returns)
            expected.push_back(truth.drives[i][static_cast<std::size_t>(side)].at(one.scan, one.beam));
          score.add(labels, expected);
        },
        run);
  labelScenes(
      model, sources.scenes, parameters.get(scene_labeler::table()).superpixel, console,
      [&](std::size_t i, const SceneInput&, scene_labeler::SceneLabels& labels) { score.add(labels, truth.scenes[i]); },
      run);
  if (score.points() == 0)
    throw urban_nav_core::DataError("SRC", "no point has a label to compare with", "labelled scenes");
  console.print(score.print());
  warnOfNewPlace(run, console);
  if (arguments.has("json")) {
    Json json = run.toJson(reportedModel(model, sources));
    score.addTo(json);
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

std::vector<Option> modelAndScenes() {
  return {{"MODEL", "", "model of labels train", true, false, {}},
          {"SRC", "", "bags, folders of scenes NAME_points.{csv,ply,las}[.gz], or such files", true, true, {}}};
}

void addCommonLabelOptions(Command& action) {
  action.options.push_back({"--precision",
                            "P",
                            "share of the labels that are not unsure which is right (default: "
                            "scene_labeler.precision, 0.98)",
                            false,
                            false,
                            {}});
  for (const Option& option : {jsonOption(), configOption(), setOption(), threadsOption()})
    action.options.push_back(option);
  for (const Option& option : driveCommandOptions()) action.options.push_back(option);
  action.more_help = labelsHelp;
}

}  // namespace

Command labelsApplyAction(const OdometryRunner& run_odometry) {
  Command action;
  action.name = "apply";
  action.summary = "Labels every laser return of scenes with a class, its probability, and whether that is unsure.";
  action.options = modelAndScenes();
  action.options.push_back({"-o,--output",
                            "DIR",
                            "folder for NAME_labels.{csv,ply,las} and, for scenes with an image, NAME_labels.png; of a "
                            "bag laser_{left,right}_labels.{csv,ply,las}, and pointsN_labels of 3D LiDARs",
                            true,
                            false,
                            {}});
  action.options.push_back(labelFormatsOption());
  action.options.push_back({"--corrections",
                            "FILE",
                            "scene with edited labels, as of labels train: teaches MODEL first; corrected points of "
                            "that scene keep their classes",
                            false,
                            false,
                            {}});
  addCommonLabelOptions(action);
  action.examples = {"urban_nav labels apply street.labels scenes -o labelled"};
  action.run = [run_odometry](const Arguments& arguments, Console& console) {
    return runLabelsApply(run_odometry, arguments, console);
  };
  return action;
}

Command labelsEvaluateAction(const OdometryRunner& run_odometry) {
  Command action;
  action.name = "evaluate";
  action.summary = "Compares the labels of a model with those in scenes.";
  action.options = modelAndScenes();
  action.options.push_back(classesOption());
  addCommonLabelOptions(action);
  action.examples = {"urban_nav labels evaluate street.labels scenes --classes classes.csv"};
  action.run = [run_odometry](const Arguments& arguments, Console& console) {
    return runLabelsEvaluate(run_odometry, arguments, console);
  };
  return action;
}

}  // namespace urban_nav
