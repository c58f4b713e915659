// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "command_line/console.hpp"
#include "command_line/json.hpp"
#include "commands/commands.hpp"
#include "pipeline/parameters.hpp"
#include "pose_graph/ceres.hpp"
#include "pose_graph/certificate.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/relative_pcg.hpp"
#include "pose_graph/robust.hpp"
#include "pose_graph/solution.hpp"
#include "report/plot.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/toro.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using pose_graph::Objective;
using pose_graph::Start;
using urban_nav_core::G2oGraph;
using urban_nav_core::UserError;

namespace {

using Clock = std::chrono::steady_clock;

Objective parseObjective(const std::string& name) {
  if (name == "chordal") return Objective::Chordal;
  return name == "g2o" ? Objective::G2o : Objective::Geodesic;
}

Start makeStart(const std::string& name) {
  if (name == "vertices") return Start::Vertices;
  if (name == "odometry") return Start::Odometry;
  return name == "identity" ? Start::Identity : Start::Auto;
}

/// TORO's files have no ending of their own; these are in use.
bool endsLikeToro(const std::string& name) {
  const auto ends = [&name](const std::string& ending) {
    return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  };
  return ends(".toro") || ends(".graph");
}

/// The paper's relaxation, from where the default solver would have begun.
template <int D>
pose_graph::Solution<D> relaxAlongChain(pose_graph::Problem<D> problem, const pose_graph::SolveOptions& options) {
  if (options.objective != Objective::Geodesic)
    throw UserError("", "--solver relative_pcg with another objective", "--objective geodesic");
  pose_graph::SolveOptions start_alone = options;
  start_alone.iterations = 0;
  start_alone.progress = {};
  problem.poses = pose_graph::solve(problem, start_alone).poses;
  pose_graph::RelativePcgOptions relative;
  relative.iterations = options.iterations;
  relative.tolerance = options.tolerance;
  relative.progress = options.progress;
  return pose_graph::relaxRelative(problem, relative);
}

/// All three costs of some poses: the one that is minimised has a mark.
struct Costs {
  double geodesic = 0.0, chordal = 0.0, g2o = 0.0;
};

template <int D>
Costs computeCosts(const pose_graph::Problem<D>& problem, const std::vector<pose_graph::Rigid<D>>& poses) {
  return {cost(problem, poses, Objective::Geodesic), cost(problem, poses, Objective::Chordal),
          cost(problem, poses, Objective::G2o)};
}

std::string toText(const char* when, const Costs& costs) {
  return std::string(when) + "geodesic " + forPerson(costs.geodesic, 9) + ", chordal " + forPerson(costs.chordal, 9) +
         ", g2o " + forPerson(costs.g2o, 9) + "\n";
}

Json toJson(const Costs& costs) {
  Json json = Json::object();
  json["geodesic"] = costs.geodesic;
  json["chordal"] = costs.chordal;
  json["g2o"] = costs.g2o;
  return json;
}

/// What the command says of the run beside the files.
struct RelaxReport {
  Costs before, after;
  std::size_t poses = 0, edges = 0, rejected = 0, iterations = 0;
  int components = 0;
  std::optional<double>
      variance;  // of the residuals, in units of what the information states; where closures were judged
  std::string ending;
  double ms = 0.0;
  std::optional<pose_graph::Certificate> certificate;  // of the accepted edges, by the chordal objective
};

std::string toText(const RelaxReport& report) {
  std::string text = std::to_string(report.poses) + " poses, " + std::to_string(report.edges) + " edges, " +
                     std::to_string(report.rejected) + " rejected; " + std::to_string(report.iterations) +
                     " iterations, " + report.ending + ", " + forPerson(report.ms, 3) + " ms\n";
  if (report.variance)
    text +=
        "errors: " + forPerson(std::sqrt(*report.variance), 2) + " times the deviations that the information states\n";
  text += toText("before: ", report.before) + toText("after:  ", report.after);
  if (!report.certificate) return text;
  const pose_graph::Certificate& certificate = *report.certificate;
  text += certificate.certified ? "certified: the global optimum" : "not certified: there may be a better optimum";
  if (certificate.gap)
    text += "; no poses cost less than " + forPerson(certificate.cost, 9) + " by more than " +
            forPerson(*certificate.gap, 2);
  return text + "\n";
}

Json toJson(const RelaxReport& report) {
  Json json = Json::object();
  json["poses"] = report.poses;
  json["edges"] = report.edges;
  json["edges_rejected"] = report.rejected;
  json["components"] = report.components;
  json["iterations"] = report.iterations;
  if (report.variance) json["variance_factor"] = *report.variance;
  json["ending"] = report.ending;
  json["ms_batch"] = report.ms;
  json["cost_before"] = toJson(report.before);
  json["cost_after"] = toJson(report.after);
  if (report.certificate) {
    json["certified"] = report.certificate->certified;
    if (report.certificate->gap) json["certified_gap"] = *report.certificate->gap;
  }
  return json;
}

template <int D>
RelaxReport relaxFile(const G2oGraph& graph, const std::string& name, const Arguments& arguments, Console& console) {
  pose_graph::SolveOptions options;
  options.objective = parseObjective(arguments.get("objective", "geodesic"));
  const bool doubted = arguments.get("robust", "on") == "on";
  const bool blocks = options.objective == Objective::Chordal && !doubted;
  const pose_graph::FileProblem<D> file = pose_graph::makeProblem<D>(
      graph, name, blocks ? pose_graph::Semidefinite::Blocks : pose_graph::Semidefinite::Whole);
  for (const std::string& note : file.notes) console.warn(name + ": " + note);
  options.start = makeStart(arguments.get("start", "auto"));
  Progress progress(console, "relax", "iterations", 0);
  options.progress = [&](int iteration, double) {
    progress.update(iteration);
    return true;
  };
  const auto begin = Clock::now();
  const std::string solver = arguments.get("solver", "gauss_newton");
  pose_graph::RobustSolution<D> robust;
  robust.edges.resize(file.problem.edges.size());
  if (doubted) robust = pose_graph::relaxRobust(file.problem, pose_graph::rolesByNumbers(file.problem), options);
  if (solver != "gauss_newton") {
    pose_graph::Problem<D> accepted;
    accepted.poses = file.problem.poses;
    for (std::size_t e = 0; e < robust.edges.size(); ++e)
      if (robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Accepted)
        accepted.edges.push_back(file.problem.edges[e]);
    robust.solution =
        solver == "ceres" ? pose_graph::solveByCeres(accepted, options) : relaxAlongChain(accepted, options);
  } else if (!doubted) {
    robust.solution = pose_graph::solve(file.problem, options);
  }
  const pose_graph::Solution<D>& solution = robust.solution;
  RelaxReport report;
  report.ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  report.poses = file.problem.poses.size();
  report.edges = file.problem.edges.size();
  report.iterations = solution.iterations.size();
  report.components = solution.components;
  report.rejected = static_cast<std::size_t>(
      std::count_if(robust.edges.begin(), robust.edges.end(), [](const pose_graph::EdgeAssessment& verdict) {
        return verdict.verdict == urban_nav_core::ClosureVerdict::Rejected;
      }));
  report.ending = toString(solution.ending);
  // Each of a component's poses but the first hangs on one trusted edge.
  const std::size_t trusted = report.poses - static_cast<std::size_t>(std::max(solution.components, 1));
  if (doubted && report.edges > trusted) report.variance = robust.variance_factor;
  report.before = computeCosts(file.problem, file.problem.poses);
  report.after = computeCosts(file.problem, solution.poses);
  if (options.objective == Objective::Chordal) {
    std::vector<double> weights;
    for (const pose_graph::EdgeAssessment& edge : robust.edges) weights.push_back(edge.weight);
    report.certificate = certify(file.problem, solution.poses, weights);
  }
  if (solution.components > 1)
    console.warn(name + ": " + std::to_string(solution.components) +
                 " parts that no edge connects; each stays in its own frame");
  if (report.edges > trusted && 2 * report.rejected > report.edges - trusted)
    console.warn(
        name + ": " + std::to_string(report.rejected) + " of " + std::to_string(report.edges - trusted) +
        " closures rejected. If most of them are true, the file's information is larger than its errors allow: "
        "--robust off takes them all");
  if (arguments.has("edges")) {
    std::string text = "from,to,weight,verdict\n";
    for (std::size_t e = 0; e < graph.edges.size(); ++e)
      text += std::to_string(graph.edges[e].from) + "," + std::to_string(graph.edges[e].to) + "," +
              urban_nav_core::printNumber(robust.edges[e].weight) + "," + toString(robust.edges[e].verdict) + "\n";
    urban_nav_core::writeAtomically(arguments.get("edges"), text);
  }
  const std::string output = arguments.get("output");
  const G2oGraph relaxed = pose_graph::withPoses<D>(graph, file, solution.poses);
  if (endsLikeToro(output)) urban_nav_core::writeToro(output, relaxed);
  else urban_nav_core::writeG2o(output, relaxed);
  return report;
}

int runRelax(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const std::string name = arguments.get("IN");
  const std::string text = urban_nav_core::readTextFile(name);
  const G2oGraph graph =
      urban_nav_core::isToro(text) ? urban_nav_core::parseToro(text, name) : urban_nav_core::parseG2o(text, name);
  const RelaxReport report = graph.dimension == 2 ? relaxFile<2>(graph, name, arguments, console)
                                                  : relaxFile<3>(graph, name, arguments, console);
  console.print(toText(report));
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(report).print());
  return 0;
}

}  // namespace

Command relaxCommand() {
  Command command;
  command.name = "relax";
  command.summary = "Optimises a pose graph: a g2o or TORO file in, the same graph with relaxed poses out.";
  command.options = {
      {"IN",
       "",
       "g2o file (VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, EDGE_SE3:QUAT) or TORO file (VERTEX2, VERTEX3, EDGE2, EDGE3)",
       true,
       false,
       {}},
      {"-o,--output",
       "OUT",
       "file to write: every vertex, and the edges of IN; in TORO's format if it ends in .toro or .graph, else in g2o's",
       true,
       false,
       {}},
      {"--objective",
       "NAME",
       "what is minimised (default geodesic); definitions in pose_graph/README.md",
       false,
       false,
       {"geodesic", "chordal", "g2o"}},
      {"--solver",
       "NAME",
       "gauss_newton (default): sparse, over the poses; relative_pcg: conjugate gradients on the transforms along the "
       "chain (Newman et al. 2009, section 5), slow, for graphs whose consecutive poses are all joined; ceres: Ceres, as a "
       "second word on the same residuals. The last two relax the edges that --robust accepted",
       false,
       false,
       {"gauss_newton", "relative_pcg", "ceres"}},
      {"--start",
       "NAME",
       "first guess (default auto: the vertices, or rotations found without any guess, whichever cost less)",
       false,
       false,
       {"auto", "vertices", "odometry", "identity"}},
      {"--robust",
       "WORD",
       "reject false closures (default on); off takes every edge as it is",
       false,
       false,
       {"on", "off"}},
      {"--edges", "CSV", "write each edge's weight and verdict: from,to,weight,verdict", false, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav relax sphere2500.g2o -o relaxed.g2o",
                      "urban_nav relax graph.g2o -o relaxed.g2o --objective chordal --robust off --edges edges.csv"};
  command.more_help = commonHelp;
  command.run = runRelax;
  return command;
}

}  // namespace urban_nav
