// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <exception>
#include <thread>

#include "errors.hpp"
#include "suite/estimators.hpp"
#include "urban_nav/run_command.hpp"

namespace py = pybind11;

namespace urban_nav_python {
namespace {

/// Ends a run because the interpreter has an error pending: not a std::exception, which stages might catch.
struct Stopped {};

/// Passes lines and progress to Python, and handles signals (Ctrl-C) during the run.
class PythonListener final : public urban_nav::RunListener {
 public:
  PythonListener(py::object on_line, py::object on_progress)
      : on_line_(std::move(on_line)), on_progress_(std::move(on_progress)), caller_(std::this_thread::get_id()) {}

  void takeLine(Kind kind, const std::string& line) override {
    call([&] { on_line_(static_cast<int>(kind), toText(line)); });
  }

  void takeProgress(const std::string& label, std::int64_t done, std::int64_t total) override {
    const Clock::time_point now = Clock::now();
    const bool is_last = total > 0 && done >= total;
    if (label == label_ && !is_last && now - called_ < kPeriod) return;
    label_ = label;
    called_ = now;
    call([&] {
      if (!on_progress_.is_none()) on_progress_(toText(label), done, total);
    });
  }

  /// Throws the Python error that ended the run, if one did. Requires the interpreter's lock.
  void rethrow() {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPeriod{50};  // between calls of Python

  template <typename Call>
  void call(const Call& function) {
    const bool is_caller = std::this_thread::get_id() == caller_;
    const py::gil_scoped_acquire lock;
    try {
      function();
      if (is_caller && PyErr_CheckSignals() != 0) throw py::error_already_set();
      return;
    } catch (py::error_already_set& error) {
      if (is_caller) error_ = std::current_exception();
      else error.discard_as_unraisable("urban_nav");
    }
    if (is_caller) throw Stopped{};
  }

  py::object on_line_, on_progress_;
  const std::thread::id caller_;
  std::string label_;
  Clock::time_point called_;
  std::exception_ptr error_;
};

/// Runs a command. Returns its exit status; errors become urban_nav.Error with the text of the command.
int run(const std::string& name, const urban_nav::NamedArguments& arguments, py::object on_line,
        py::object on_progress) {
  PythonListener listener(std::move(on_line), std::move(on_progress));
  int status = 0;
  std::string failure;
  try {
    const py::gil_scoped_release unlocked;
    status = urban_nav::runCommand(name, arguments, listener);
  } catch (const Stopped&) {
    // The error of Python follows.
  } catch (const urban_nav_core::Error&) {
    listener.rethrow();
    throw;
  } catch (const std::exception& error) {
    failure = std::string("aborted: ") + error.what();
  }
  listener.rethrow();
  if (!failure.empty()) {
    setError(failure.c_str(), 1);
    throw py::error_already_set();
  }
  return status;
}

}  // namespace

PYBIND11_MODULE(_suite, module) {
  module.doc() = "Runs commands and estimators of the suite; the public functions are those of urban_nav.";
  registerErrors();
  module.def("run", &run, py::arg("name"), py::arg("arguments"), py::arg("on_line"), py::arg("on_progress"));
  addStore(module);
  addEstimators(module);
}

}  // namespace urban_nav_python
