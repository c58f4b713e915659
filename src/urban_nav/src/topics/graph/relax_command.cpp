// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "pose_graph/false_priors.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/parameters.hpp"
#include "pose_graph/robust.hpp"
#include "pose_graph/selection_warnings.hpp"
#include "pose_graph/solution.hpp"
#include "pose_graph_ceres/solve_by_ceres.hpp"
#include "pose_graph_relative/relative_pcg.hpp"
#include "topics/graph/graph.hpp"
#include "topics/graph/relax_files.hpp"
#include "topics/graph/relax_report.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
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

/// Returns whether a name has one of the usual extensions of TORO files.
bool endsLikeToro(const std::string& name) {
  const auto ends = [&name](const std::string& ending) {
    return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  };
  return ends(".toro") || ends(".graph");
}

/// Relaxes by the method of the paper, from the initial guess of the default solver.
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

template <int D>
GraphCosts computeCosts(const pose_graph::Problem<D>& problem, const std::vector<pose_graph::Rigid<D>>& poses) {
  return {cost(problem, poses, Objective::Geodesic), cost(problem, poses, Objective::Chordal),
          cost(problem, poses, Objective::G2o)};
}

/// Returns the parameters of the stage, overridden by the options of the command.
pose_graph::Parameters relaxParameters(const Arguments& arguments) {
  pose_graph::Parameters parameters = loadParameters(arguments).get(pose_graph::table());
  parameters.solver = arguments.get("solver", parameters.solver);
  parameters.robust = arguments.get("robust", parameters.robust ? "on" : "off") == "on";
  return parameters;
}

/// Returns the graph without rejected priors and closures.
template <int D>
pose_graph::RobustSolution<D> selected(const pose_graph::FileProblem<D>& file,
                                       const pose_graph::SolveOptions& options) {
  const pose_graph::FalsePriors wrong = pose_graph::findFalsePriors(file);
  pose_graph::RobustSolution<D> robust;
  if (wrong.rejected.empty()) {
    robust = pose_graph::relaxSelected(file.problem, file.roles, options);
  } else {
    pose_graph::Problem<D> without = file.problem;
    for (const int e : wrong.rejected) without.edges[static_cast<std::size_t>(e)].information.setZero();
    robust = pose_graph::relaxSelected(without, file.roles, options);
  }
  for (const int e : wrong.rejected) {
    pose_graph::EdgeAssessment& edge = robust.edges[static_cast<std::size_t>(e)];
    edge.weight = 0.0;
    edge.verdict = urban_nav_core::ClosureVerdict::Rejected;
    edge.reason = pose_graph::Reason::Disagrees;
  }
  robust.selection.undecided_priors = wrong.undecided;
  return robust;
}

/// Poses, and weight and verdict of each edge.
template <int D>
pose_graph::RobustSolution<D> solved(const pose_graph::FileProblem<D>& file, const pose_graph::Parameters& parameters,
                                     const pose_graph::SolveOptions& options) {
  const bool is_robust = parameters.robust;
  const std::string& solver = parameters.solver;
  const bool is_constrained =
      !file.problem.fixed.empty() || !file.priors.empty() || !file.point_edges.empty() || !file.point_ids.empty();
  if (solver == "relative_pcg" && is_constrained)
    throw UserError("", "--solver relative_pcg with priors, landmarks or fixed vertices",
                    "--solver gauss_newton, ceres");
  pose_graph::RobustSolution<D> robust;
  robust.edges.resize(file.problem.edges.size());
  if (is_robust) robust = selected(file, options);
  if (solver != "gauss_newton") {
    pose_graph::Problem<D> accepted = file.problem.withoutEdges();
    for (std::size_t e = 0; e < robust.edges.size(); ++e)
      if (robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Accepted)
        accepted.edges.push_back(file.problem.edges[e]);
    robust.solution =
        solver == "ceres" ? pose_graph::solveByCeres(accepted, options) : relaxAlongChain(accepted, options);
  } else if (!is_robust) {
    robust.solution = pose_graph::solve(file.problem, options);
  }
  return robust;
}

/// Prints warnings and keeps them for the summary.
class Warnings {
 public:
  Warnings(Console& console, std::string name, std::vector<std::string>& kept)
      : console_(console), name_(std::move(name)), kept_(kept) {}

  void add(const std::string& warning) {
    console_.warn(name_ + ": " + warning);
    kept_.push_back(warning);
  }

 private:
  Console& console_;
  std::string name_;
  std::vector<std::string>& kept_;
};

template <int D>
std::size_t rejectedEdges(const pose_graph::FileProblem<D>& file, const pose_graph::RobustSolution<D>& robust) {
  return static_cast<std::size_t>(std::count_if(file.edges.begin(), file.edges.end(), [&](int edge) {
    return edge >= 0 &&
           robust.edges[static_cast<std::size_t>(edge)].verdict == urban_nav_core::ClosureVerdict::Rejected;
  }));
}

template <int D>
void summarise(const pose_graph::FileProblem<D>& file, const pose_graph::RobustSolution<D>& robust, bool is_robust,
               Warnings& warnings, RelaxReport& report) {
  const pose_graph::Solution<D>& solution = robust.solution;
  report.poses = file.ids.size();
  report.edges = file.edges.size();
  report.landmarks = file.point_ids.size();
  report.landmark_edges = file.point_edges.size();
  report.priors = file.priors.size();
  report.iterations = solution.iterations.size();
  report.components = solution.components;
  report.rejected = rejectedEdges(file, robust);
  report.ending = toString(solution.ending);
  if (isEarly(solution.ending)) {
    report.gradient = solution.gradient;
    warnings.add(endingWarning(solution.ending, solution.iterations.size(), solution.gradient));
  }
  // Each pose of a component except the first has one trusted edge.
  const std::size_t trusted = report.poses - static_cast<std::size_t>(std::max(solution.components, 1));
  if (is_robust && report.edges > trusted) report.variance = robust.variance_factor;
  report.before = computeCosts(file.problem, file.problem.poses);
  report.after = computeCosts(file.problem, solution.poses);
  if (solution.components > 1)
    warnings.add(std::to_string(solution.components) + " parts that no edge connects; each stays in its own frame");
  if (solution.may_be_tangled)
    warnings.add(
        "rotations are far from the measurements: there may be a better minimum, which is searched for in smaller "
        "graphs only");
  // A tree has no redundant edges, hence no residuals.
  const std::size_t parts = static_cast<std::size_t>(std::max(solution.components, 1));
  const std::size_t held = parts + std::max<std::size_t>(file.problem.fixed.size(), 1) - 1;
  if (!is_robust || file.problem.edges.size() + held <= file.problem.poses.size()) return;
  report.scales = estimateScales(file.problem, file.roles, robust.edges, solution.poses, robust.selection);
  for (const std::string& warning : pose_graph::selectionWarnings(file, robust, *report.scales)) warnings.add(warning);
}

template <int D>
void writeOutputs(const G2oGraph& graph, const pose_graph::FileProblem<D>& file,
                  const pose_graph::RobustSolution<D>& robust, const Arguments& arguments) {
  const auto write = [](const std::string& path, const G2oGraph& written) {
    if (endsLikeToro(path)) urban_nav_core::writeToro(path, written);
    else urban_nav_core::writeG2o(path, written);
  };
  if (arguments.has("edges"))
    urban_nav_core::writeAtomically(arguments.get("edges"), edgesCsv(graph, file, robust.edges));
  if (arguments.has("covariance"))
    urban_nav_core::writeAtomically(arguments.get("covariance"),
                                    covarianceCsv(file, robust.edges, robust.solution.poses));
  if (arguments.has("rejected")) write(arguments.get("rejected"), withoutRejected(graph, file, robust.edges));
  write(arguments.get("output"), pose_graph::withPoses<D>(graph, file, robust.solution.poses));
}

template <int D>
RelaxReport relaxFile(const G2oGraph& graph, const std::string& name, const Arguments& arguments, Console& console) {
  RelaxReport report;
  Warnings warnings(console, name, report.warnings);
  for (const auto& [tag, count] : unknownTags(graph))
    warnings.add(std::to_string(count) + " lines " + tag + " are of an unknown kind and are left out");
  const pose_graph::Parameters parameters = relaxParameters(arguments);
  pose_graph::SolveOptions options;
  options.objective = parseObjective(arguments.get("objective", "geodesic"));
  options.iterations = parameters.iterations;
  const bool is_robust = parameters.robust;
  const bool blocks = options.objective == Objective::Chordal && !is_robust;
  const pose_graph::FileProblem<D> file = pose_graph::makeProblem<D>(
      graph, name, blocks ? pose_graph::Semidefinite::Blocks : pose_graph::Semidefinite::Whole);
  for (const std::string& note : file.notes) warnings.add(note);
  options.start = makeStart(arguments.get("start", "auto"));
  Progress progress(console, "relax", "iterations", 0);
  options.progress = [&](int iteration, double) {
    progress.update(iteration);
    return true;
  };
  const auto begin = Clock::now();
  pose_graph::RobustSolution<D> robust = solved(file, parameters, options);
  report.ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  if (options.objective == Objective::Chordal) {
    std::vector<double> weights;
    for (const pose_graph::EdgeAssessment& edge : robust.edges) weights.push_back(edge.weight);
    report.certificate = certifyConverged(file.problem, robust.solution.poses, weights);
  }
  summarise(file, robust, is_robust, warnings, report);
  writeOutputs(graph, file, robust, arguments);
  return report;
}

int runRelax(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const std::string name = arguments.get("IN");
  const std::string text = urban_nav_core::readTextFile(name);
  const auto unknown =
      arguments.has("ignore-unknown") ? urban_nav_core::UnknownTags::Keep : urban_nav_core::UnknownTags::Refuse;
  const G2oGraph graph = urban_nav_core::isToro(text) ? urban_nav_core::parseToro(text, name, unknown)
                                                      : urban_nav_core::parseG2o(text, name, unknown);
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
       "g2o file (poses VERTEX_SE2, VERTEX_SE3:QUAT and edges between them, landmarks, priors, FIX) or TORO file "
       "(VERTEX2, VERTEX3, EDGE2, EDGE3)",
       true,
       false,
       {}},
      {"-o,--output",
       "OUT",
       "file to write: every vertex, and the edges of IN; in TORO's format if it ends in .toro or .graph, else in "
       "g2o's",
       true,
       false,
       {}},
      {"--objective",
       "NAME",
       "objective function (default geodesic); definitions in pose_graph/README.md",
       false,
       false,
       {"geodesic", "chordal", "g2o"}},
      {"--solver",
       "NAME",
       "gauss_newton (default): sparse, over the poses; relative_pcg: conjugate gradients on the transforms along the "
       "chain (Newman et al. 2009, section 5), slow, for graphs whose consecutive poses are all joined; ceres: Ceres, "
       "as an independent solver of the same residuals. The last two relax the edges that --robust accepted",
       false,
       false,
       {"gauss_newton", "relative_pcg", "ceres"}},
      {"--start",
       "NAME",
       "initial guess (default auto: the vertices, or rotations estimated without a guess, whichever costs less)",
       false,
       false,
       {"auto", "vertices", "odometry", "identity"}},
      {"--robust", "WORD", "reject false closures (default on); off: use every edge", false, false, {"on", "off"}},
      {"--edges", "CSV", "write each edge's weight and verdict: from,to,weight,verdict,reason", false, false, {}},
      {"--covariance", "CSV", "write each vertex and its marginal covariance, row by row", false, false, {}},
      {"--rejected", "G2O", "write IN without the rejected edges", false, false, {}},
      {"--ignore-unknown", "", "leave out lines of unknown kinds, named and counted", false, false, {}},
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
