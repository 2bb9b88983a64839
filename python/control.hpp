// control.hpp - long calls without the GIL, which Ctrl-C stops.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <kreisel/kreisel.hpp>
#include <string>

namespace kreisel::python {

namespace py = pybind11;

/// Ctrl-C during a call of the main thread asks the call to stop; Python hears of it, too. Nobody registers a
/// callback with the source, so that to ask is no more than an atomic operation.
/// A call inside another's callback stops with that.
class StopOnInterrupt {
 public:
  StopOnInterrupt() {
    const bool main = ::gettid() == ::getpid();  // the thread that Python handles signals in
    if (!main) return;
    outermost_ = calls++ == 0;
    inside_ = true;
    if (outermost_) {
      source = {};
      struct sigaction ours {};
      ours.sa_handler = on_signal;
      sigaction(SIGINT, &ours, &previous);
      if (previous.sa_handler == SIG_IGN) sigaction(SIGINT, &previous, nullptr);
    }
    token_ = source.get_token();
  }
  ~StopOnInterrupt() {
    if (!inside_) return;
    --calls;
    if (outermost_) sigaction(SIGINT, &previous, nullptr);
  }
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return token_; }

 private:
  static void on_signal(int number) {
    source.request_stop();
    if (previous.sa_handler != SIG_IGN && previous.sa_handler != SIG_DFL) previous.sa_handler(number);
  }

  bool inside_ = false, outermost_ = false;
  std::stop_token token_;
  static inline int calls = 0;  ///< of the main thread, one inside the other
  static inline std::stop_source source;
  static inline struct sigaction previous {};
};

/// Runs `work(control)` without the GIL. @throws KeyboardInterrupt  by Ctrl-C
template <class Work>
auto without_gil(const Work& work, const std::function<void(const std::string&)>& progress = {}) {
  try {
    const StopOnInterrupt interrupt;
    Control control;
    control.stop = interrupt.token();
    if (progress)
      control.progress = [&](const std::string& step) {
        const py::gil_scoped_acquire held;
        progress(step);
      };
    const py::gil_scoped_release released;
    return work(control);
  } catch (const Interrupted&) {
    if (PyErr_CheckSignals() == 0) PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
}

}  // namespace kreisel::python
