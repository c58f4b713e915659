// SPDX-License-Identifier: BSD-3-Clause
#include "edits/edit_request.hpp"

#include <algorithm>
#include <cmath>

#include "base/parameters.hpp"
#include "edits/edit_measurement.hpp"
#include "edits/moments.hpp"
#include "pose_graph/stored_edits.hpp"
#include "topics/lasers/map_crs.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/digest.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Pose;
using urban_nav_core::UserError;
using urban_nav_store::EdgeKind;
using urban_nav_store::NodeRef;
using urban_nav_store::Store;
using urban_nav_store::StoredEdit;

namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;
constexpr double kAssertedSigma = 0.1,
                 kAssertedDegrees = 1.0;  // m, deg: of a transform estimated by eye in a view of the map
constexpr double kPinnedSigma = 0.02;     // m: a surveyed point
constexpr std::size_t kDigits = 8;        // hexadecimal, of a digest

/// Quotes text as one word of a shell.
std::string shellWord(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("_./:,+=@%-").find(c) != std::string::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// The action and arguments after STORE.
class Words {
 public:
  explicit Words(const Arguments& arguments) : arguments_(arguments), words_(arguments.all("ARGUMENT")) {}

  void require(std::size_t least, std::size_t most, const std::string& expected,
               const std::vector<std::string>& options = {}) const {
    if (words_.size() < least || words_.size() > most)
      throw UserError("urban_nav edge", std::to_string(words_.size()) + " arguments after " + arguments_.get("ACTION"),
                      expected);
    for (const char* name : {"pose", "sigma", "at", "geodetic", "point"})
      if (arguments_.has(name) && std::find(options.begin(), options.end(), name) == options.end())
        throw UserError(std::string("--") + name, "with " + arguments_.get("ACTION"), expected);
  }
  const std::string& operator[](std::size_t i) const { return words_[i]; }
  std::size_t size() const { return words_.size(); }
  /// Returns the words in the form of the journal.
  std::string print() const {
    std::string text;
    for (const std::string& word : words_) text += (text.empty() ? "" : " ") + shellWord(word);
    for (const char* name : {"pose", "at", "geodetic", "point", "sigma"})
      if (arguments_.has(name)) text += std::string(" --") + name + " " + shellWord(arguments_.get(name));
    return text;
  }
  /// Returns the numbers of an option.
  std::vector<double> numbers(const std::string& name, std::size_t count, const std::string& expected) const {
    std::vector<double> result;
    const std::string text = arguments_.get(name);
    for (const std::string_view each : urban_nav_core::splitAt(text, ',')) {
      const std::optional<double> value = urban_nav_core::parseNumber(each);
      if (!value) throw UserError("--" + name, "\"" + std::string(each) + "\" is not a finite number", expected);
      result.push_back(*value);
    }
    if (result.size() != count)
      throw UserError("--" + name, std::to_string(result.size()) + " numbers in \"" + text + "\"", expected);
    return result;
  }
  bool has(const std::string& name) const { return arguments_.has(name); }

 private:
  const Arguments& arguments_;
  const std::vector<std::string> words_;
};

std::string listNumbers(const std::vector<StoredClosure>& closures) {
  if (closures.empty()) return "none: the store holds no closures";
  std::string text;
  for (std::size_t i = 0; i < closures.size();) {
    std::size_t last = i;
    while (last + 1 < closures.size() && closures[last + 1].id == closures[last].id + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(closures[i].id) +
            (last > i ? "..." + std::to_string(closures[last].id) : "");
    i = last + 1;
  }
  return text + " (urban_nav edge STORE list)";
}

const StoredClosure& findClosure(const std::vector<StoredClosure>& closures, const std::string& text) {
  const std::optional<std::int64_t> id = urban_nav_core::parseInteger(text);
  if (!id) throw UserError("ID", "\"" + text + "\" is not a number", listNumbers(closures));
  const auto found =
      std::find_if(closures.begin(), closures.end(), [&](const StoredClosure& closure) { return closure.id == *id; });
  if (found == closures.end()) throw UserError("ID", text + ": no such closure", listNumbers(closures));
  return *found;
}

std::string inWords(const StoredClosure& closure) { return "closure " + std::to_string(closure.id); }

/// Returns the reason why a manual verdict would change nothing; empty if it may.
std::string whyVerdictIsIdle(const StoredClosure& closure, const std::string& action,
                             const std::vector<StoredEdit>& standing) {
  const StoredEdit* last = nullptr;
  for (const StoredEdit& edit : standing)
    if ((edit.action == "reject" || edit.action == "accept") && edgeKey(edit.edge) == edgeKey(closure.edge))
      last = &edit;
  if (last != nullptr && last->action == action)
    return inWords(closure) + " is " + action + "ed already, by edit " + std::to_string(last->number);
  if (closure.edge.measured.information.isZero(0.0))
    return inWords(closure) + " has no transform" + (closure.edge.reason.empty() ? "" : ": " + closure.edge.reason);
  if (action == "accept" && closure.edge.verdict == ClosureVerdict::Accepted)
    return inWords(closure) + " is accepted already";
  return {};
}

EditRequest readVerdict(const std::string& action, const Words& words, Store& store) {
  words.require(1, 1, action + " ID");
  std::vector<StoredClosure> closures = listClosures(store);
  closures.erase(std::remove_if(closures.begin(), closures.end(),
                                [](const StoredClosure& closure) { return closure.edge.kind == EdgeKind::Plane; }),
                 closures.end());
  const StoredClosure& closure = findClosure(closures, words[0]);
  const std::vector<StoredEdit> standing = urban_nav_store::EditJournal(store).standing();
  EditRequest request{action, {}};
  StoredEdit& edit = request.edit;
  edit.action = action;
  edit.edge = closure.edge;
  if (action == "remove" || urban_nav_store::isOfEdit(closure.edge.source)) {
    const auto added = std::find_if(standing.begin(), standing.end(), [&](const StoredEdit& each) {
      return each.edge.source == closure.edge.source && each.action != "remove" && each.action != "reject" &&
             each.action != "accept";
    });
    if (action == "remove" && added == standing.end())
      throw UserError("remove", inWords(closure) + " was not added by an edit",
                      "reject " + words[0] + ", or the ID of an asserted or measured closure or of a pin");
    if (action != "remove" && added != standing.end() && added->action == "pin")
      throw UserError(action, inWords(closure) + " is a pin", "remove " + words[0]);
    if (action == "remove") edit.edge = added->edge;
  } else {
    request.unchanged = whyVerdictIsIdle(closure, action, standing);
  }
  edit.edge.measured = {};
  edit.session = edit.edge.b.session;
  return request;
}

/// Returns a unique source for the closure of an edit, which depends only on their content.
std::string makeSource(const StoredEdit& edit, const std::string& kind) {
  std::string text = kind + edit.edge.a.session + std::to_string(edit.edge.a.stamp) + edit.edge.b.session +
                     std::to_string(edit.edge.b.stamp) + edit.arguments;
  return std::string(urban_nav_store::kEditSource) + " " + kind + " " +
         urban_nav_store::sha256(text).substr(0, kDigits);
}

double positive(double value, const std::string& option, const std::string& expected) {
  if (!(value > 0.0)) throw UserError(option, urban_nav_core::printNumber(value) + " is not positive", expected);
  return value;
}

void readMoments(const Words& words, const PreviousSessions& sessions, StoredEdit& edit) {
  edit.edge.a = findMoment(sessions, words[0], "T1");
  edit.edge.b = findMoment(sessions, words[1], "T2");
  if (edit.edge.a == edit.edge.b) throw UserError("T2", words[1] + " has the same pose as T1", "two different moments");
  edit.session = edit.edge.b.session;
}

EditRequest readAssertion(const Words& words, const PreviousSessions& sessions) {
  const std::string expected = "assert T1 T2 --pose X,Y,Z,QX,QY,QZ,QW [--sigma M,DEG]";
  words.require(2, 2, expected, {"pose", "sigma"});
  EditRequest request{"assert", {}};
  StoredEdit& edit = request.edit;
  readMoments(words, sessions, edit);
  const std::vector<double> v =
      words.numbers("pose", 7, "seven finite numbers X,Y,Z,QX,QY,QZ,QW: T_a_b of base_link, m and a unit quaternion");
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1.0) > 0.01)
    throw UserError("--pose", "a quaternion of norm " + urban_nav_core::printNumber(q.norm()),
                    "a unit quaternion QX,QY,QZ,QW");
  double sigma = kAssertedSigma, degrees = kAssertedDegrees;
  if (words.has("sigma")) {
    const std::vector<double> given = words.numbers("sigma", 2, "two positive numbers M,DEG");
    sigma = positive(given[0], "--sigma", "positive numbers M,DEG");
    degrees = positive(given[1], "--sigma", "positive numbers M,DEG");
  }
  const double radians = kRadiansPerDegree * degrees;
  edit.action = "assert";
  edit.arguments = words.print();
  edit.edge.kind = EdgeKind::Asserted;
  edit.edge.source = makeSource(edit, "assert");
  edit.edge.measured.T_a_b = Pose(q.normalized(), {v[0], v[1], v[2]});
  edit.edge.measured.information.diagonal().head<3>().setConstant(1.0 / (sigma * sigma));
  edit.edge.measured.information.diagonal().tail<3>().setConstant(1.0 / (radians * radians));
  return request;
}

/// Returns the point of a map at a position, by the GPS fixes of its sessions.
Eigen::Vector3d placeByFixes(Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map,
                             const laser_mapper::Geodetic& position) {
  try {
    return MapCrs("auto", "", store, map).toMap(position);
  } catch (const urban_nav_core::DataError& error) {
    throw urban_nav_core::DataError("--geodetic", error.parts().found, "--at X,Y,Z: a place in the frame map");
  }
}

/// Returns the position of a pinned point in the map, m.
Eigen::Vector3d readPlace(const Words& words, Store& store, const NodeRef& at) {
  if (words.has("at") == words.has("geodetic"))
    throw UserError("pin", words.has("at") ? "--at and --geodetic" : "neither --at nor --geodetic", "one of the two");
  if (words.has("at")) {
    const std::vector<double> v = words.numbers("at", 3, "three finite numbers X,Y,Z: m, in the frame map");
    return {v[0], v[1], v[2]};
  }
  const std::vector<double> v = words.numbers("geodetic", 3, "three finite numbers LAT,LON,H: deg and m, WGS 84");
  if (std::abs(v[0]) > 90.0 || std::abs(v[1]) > 180.0)
    throw UserError("--geodetic", "latitude or longitude out of range", "LAT -90...90, LON -180...180 (deg)");
  for (const std::vector<urban_nav_store::StoredTrajectory>& map :
       readMaps(store, urban_nav_store::selectSessions(store, {})))
    for (const urban_nav_store::StoredTrajectory& each : map)
      if (each.session.id == at.session)
        return placeByFixes(store, map, {kRadiansPerDegree * v[0], kRadiansPerDegree * v[1], v[2]});
  throw urban_nav_core::DataError(store.path(), "holds no map of session " + at.session, "");
}

EditRequest readPin(const Words& words, Store& store, const StoredMeasurements& measurements) {
  const std::string expected = "pin T --at X,Y,Z (or --geodetic LAT,LON,H) [--point U,V] [--sigma M]";
  words.require(1, 1, expected, {"at", "geodetic", "point", "sigma"});
  EditRequest request{"pin", {}};
  StoredEdit& edit = request.edit;
  edit.edge.a = findMoment(measurements.sessions, words[0], "T");
  edit.p_map = readPlace(words, store, edit.edge.a);
  if (words.has("point")) {
    const std::vector<double> pixel = words.numbers("point", 2, "two finite numbers U,V: px, in the left view at T");
    const SeenPoint seen = findSeenPoint(store, measurements, edit.edge.a, pixel[0], pixel[1]);
    edit.edge.a.stamp = seen.stamp;
    edit.edge.a = findMoment(measurements.sessions, urban_nav_core::printStamp(seen.stamp), "T");
    edit.p_base = seen.p_base;
  }
  edit.sigma = kPinnedSigma;
  if (words.has("sigma"))
    edit.sigma = positive(words.numbers("sigma", 1, "a positive number, m").front(), "--sigma", "a positive number, m");
  edit.edge.b = edit.edge.a;
  edit.session = edit.edge.b.session;
  edit.action = "pin";
  edit.arguments = words.print();
  edit.edge.kind = EdgeKind::Asserted;
  edit.edge.source = makeSource(edit, "pin");
  return request;
}

EditRequest readCut(const Words& words, const PreviousSessions& sessions) {
  words.require(2, 2, "cut SESSION T");
  EditRequest request{"cut", {}};
  StoredEdit& edit = request.edit;
  const std::size_t session = findSession(sessions, words[0]);
  PreviousSessions alone;
  alone.ids = {sessions.ids[session]};
  alone.names = {sessions.names[session]};
  alone.runs = {sessions.runs[session]};
  NodeRef last = findMoment(alone, words[1], "T");
  const std::vector<SmoothedFrame>& settled = sessions.runs[session].settled;
  if (settled.size() < 4) {
    request.unchanged = "session " + sessions.names[session] + " has too few poses for a cut";
    return request;
  }
  // Both pieces need at least one step, i.e. two poses.
  last.stamp = std::clamp(last.stamp, settled[1].stamp, settled[settled.size() - 3].stamp);
  edit.edge.a = edit.edge.b = last;
  edit.session = last.session;
  edit.action = "cut";
  edit.arguments = words.print();
  return request;
}

EditRequest readOrigin(const Words& words, Store& store, const PreviousSessions& sessions) {
  words.require(1, 1, "origin T");
  EditRequest request{"origin", {}};
  StoredEdit& edit = request.edit;
  edit.edge.a = edit.edge.b = findMoment(sessions, words[0], "T");
  edit.session = edit.edge.a.session;
  edit.action = "origin";
  edit.arguments = words.print();
  for (const StoredEdit& other : urban_nav_store::EditJournal(store).standing())
    if (other.action == "pin")
      request.unchanged = "the pin of edit " + std::to_string(other.number) +
                          " holds coordinates of the present map; set the origin first, then pin";
  return request;
}

EditRequest readMeasurement(const Arguments& arguments, const Words& words, Store& store,
                            const StoredMeasurements& measurements) {
  words.require(2, 2, "measure T1 T2");
  EditRequest request{"measure", {}};
  StoredEdit& edit = request.edit;
  readMoments(words, measurements.sessions, edit);
  const urban_nav_core::MetricClosure measured =
      measurePair(store, measurements, loadParameters(arguments), edit.edge.a, edit.edge.b);
  edit.action = "measure";
  edit.arguments = words.print();
  edit.edge.kind = measured.method == urban_nav_core::ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
  edit.edge.source = makeSource(edit, "measure");
  edit.edge.measured = measured.measured;
  edit.evidence = measured.evidence;
  if (measured.verdict == ClosureVerdict::Accepted) return request;
  edit.edge.verdict = ClosureVerdict::Rejected;
  edit.edge.reason = measured.reason_name + ": " + measured.sentence;
  request.unchanged = "the pair is not accepted: " + edit.edge.reason;
  return request;
}

EditRequest readUndo(const std::string& action, const Words& words, Store& store) {
  words.require(0, action == "undo" ? 1 : 0, action == "undo" ? "undo [N]" : "redo");
  EditRequest request{action, {}};
  if (words.size() == 1) {
    const std::optional<std::int64_t> count = urban_nav_core::parseInteger(words[0]);
    if (!count || *count < 1) throw UserError("undo", "\"" + words[0] + "\"", "a number of at least 1");
    request.count = static_cast<std::size_t>(*count);
  }
  const std::vector<StoredEdit> all = urban_nav_store::EditJournal(store).all();
  const bool any = std::any_of(all.begin(), all.end(), [&](const StoredEdit& edit) {
    return action == "undo" ? !edit.undone : edit.undone && !edit.dropped;
  });
  if (!any) request.unchanged = "nothing to " + action;
  return request;
}

}  // namespace

const std::vector<std::string>& editActions() {
  static const std::vector<std::string> all = {"reject", "accept", "remove", "measure", "assert",
                                               "pin",    "cut",    "origin", "undo",    "redo"};
  return all;
}

EditRequest readEditRequest(const Arguments& arguments, Store& store, const StoredMeasurements& measurements) {
  const Words words(arguments);
  const std::string action = arguments.get("ACTION");
  if (action == "undo" || action == "redo") return readUndo(action, words, store);
  if (action == "assert") return readAssertion(words, measurements.sessions);
  if (action == "measure") return readMeasurement(arguments, words, store, measurements);
  if (action == "pin") return readPin(words, store, measurements);
  if (action == "cut") return readCut(words, measurements.sessions);
  if (action == "origin") return readOrigin(words, store, measurements.sessions);
  return readVerdict(action, words, store);
}

}  // namespace urban_nav
