#include "api/sweep/sweep.hpp"

#include "python/bindings/bindings.hpp"
#include "python/bindings/jobs.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

namespace gnomon::python {
namespace {

namespace py = pybind11;

struct SweepRequest {
    std::vector<std::string> axes; ///< "KEY=[…]"
    std::string case_name;
    std::string folder;
    bool keeps_pixels = false;
    bool verifies = false;
    bool retries_failed = false;
    bool may_replace = false;
    std::string job_text, command, compare_command;
};

/// Reports a sweep's progress to Python, and checks for Ctrl-C.
api::SweepWatcher watcher_for(const py::function& tell, bool& is_stopped)
{
    api::SweepWatcher watcher;
    watcher.begin = [&tell](std::uint64_t total, std::uint64_t known) {
        const py::gil_scoped_acquire acquired;
        tell("begin", total, known);
    };
    watcher.advance = [&tell](std::uint64_t done, std::uint64_t failed) {
        const py::gil_scoped_acquire acquired;
        tell("advance", done, failed);
    };
    watcher.should_stop = [&is_stopped] {
        const py::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0) {
            PyErr_Clear(); // raised again after the sweep
            is_stopped = true;
        }
        return is_stopped;
    };
    return watcher;
}

void sweep(const JobPlace& place, const TextPairs& keys, const SweepRequest& request,
           const py::function& tell, std::optional<int> device, int threads)
{
    bool is_stopped = false;
    {
        const py::gil_scoped_release released;
        const scene::SweepSpace space{source_of(place, keys), request.axes, request.case_name};
        const GlTurn turn{device};
        api::SweepRunOptions options;
        options.folder = request.folder;
        options.keeps_pixels = request.keeps_pixels;
        options.verifies = request.verifies;
        options.retries_failed = request.retries_failed;
        options.may_replace = request.may_replace;
        options.job_text = request.job_text;
        options.command = request.command;
        options.compare_command = request.compare_command;
        options.session = turn.options(threads);
        (void)api::sweep(space, options, watcher_for(tell, is_stopped));
    }
    if (is_stopped) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw py::error_already_set();
    }
}

} // namespace

void bind_sweep(py::module_& module)
{
    py::class_<SweepRequest>(module, "SweepRequest")
        .def(py::init<>())
        .def_readwrite("axes", &SweepRequest::axes)
        .def_readwrite("case_name", &SweepRequest::case_name)
        .def_readwrite("folder", &SweepRequest::folder)
        .def_readwrite("keeps_pixels", &SweepRequest::keeps_pixels)
        .def_readwrite("verifies", &SweepRequest::verifies)
        .def_readwrite("retries_failed", &SweepRequest::retries_failed)
        .def_readwrite("may_replace", &SweepRequest::may_replace)
        .def_readwrite("job_text", &SweepRequest::job_text)
        .def_readwrite("command", &SweepRequest::command)
        .def_readwrite("compare_command", &SweepRequest::compare_command);
    module.def("sweep", &sweep);
}

} // namespace gnomon::python
