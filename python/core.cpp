// coseg._core: the interface of include/coseg/coseg.hpp on arrays of NumPy. What users see is python/coseg.
//
// Arrays come contiguous and in the right type (the Python side sees to it) and are used in place. The
// interpreter is free while coseg works; the progress function takes it back for as long as it needs.

#include <mpi.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include <chrono>
#include <coseg/coseg.hpp>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace {

using Doubles = py::array_t<double, py::array::c_style>;
using Ints = py::array_t<int, py::array::c_style>;

template <class T>
std::span<const T> span_of(const py::array_t<T, py::array::c_style>& array) {
    return {array.data(), static_cast<std::size_t>(array.size())};
}

/// An array that takes over the vector's memory.
template <class T>
py::array_t<T> array_of(std::vector<T>&& values, std::vector<py::ssize_t> shape = {}) {
    auto kept = std::make_unique<std::vector<T>>(std::move(values));
    if (shape.empty()) shape = {static_cast<py::ssize_t>(kept->size())};
    const T* data = kept->data();
    const py::capsule owner(kept.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    return py::array_t<T>(shape, data, owner);
}

/// Names of files need not be UTF-8; Python then has them as os.fsdecode does.
py::str text_of(const std::string& text) {
    PyObject* decoded =
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
    if (decoded == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
}

py::list texts_of(const std::vector<std::string>& texts) {
    py::list list;
    for (const std::string& text : texts) list.append(text_of(text));
    return list;
}

/// A communicator as its Fortran handle, which mpi4py and others give; nothing: this process alone.
using Communicator = std::optional<int>;

/// Runs `work(call)` with the interpreter free. Signals of Python, such as Ctrl-C, are looked for whenever a
/// stage says how far it is, but at most every 50 ms: taking the interpreter back costs.
template <class Work>
auto in_call(const Communicator& communicator, const py::object& progress, Work&& work) {
    const MPI_Comm comm = communicator ? MPI_Comm_f2c(*communicator) : MPI_COMM_NULL;
    coseg::Call call;
    if (communicator) call.communicator = &comm;
    auto last = std::chrono::steady_clock::now();
    call.progress = [&](const coseg::Progress& at) {
        const auto now = std::chrono::steady_clock::now();
        if (progress.is_none() && now - last < std::chrono::milliseconds(50)) return;
        last = now;
        const py::gil_scoped_acquire held;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!progress.is_none()) progress(at.stage, at.done, at.total);
    };
    const py::gil_scoped_release released;
    return work(call);
}

/// The same for work that has no progress, such as reading a file.
template <class Work>
auto with_interpreter_free(Work&& work) {
    const py::gil_scoped_release released;
    return work();
}

/// A shape as the Python side hands it over: (name, path, vertices, corners, offsets).
using GivenShape = std::tuple<std::string, std::string, Doubles, Ints, Ints>;

std::vector<coseg::Shape> shapes_of(const std::vector<GivenShape>& given) {
    std::vector<coseg::Shape> shapes;
    for (const auto& [name, path, vertices, corners, offsets] : given)
        shapes.push_back({name, path, span_of(vertices), span_of(corners), span_of(offsets)});
    return shapes;
}

std::vector<std::vector<int>> vectors_of(const std::vector<Ints>& arrays) {
    std::vector<std::vector<int>> vectors;
    for (const Ints& array : arrays) vectors.emplace_back(array.data(), array.data() + array.size());
    return vectors;
}

py::dict dict_of(const coseg::Certificate& certificate) {
    py::dict dict;
    dict["objective"] = certificate.objective;
    dict["lower_bound"] = certificate.lower_bound;
    dict["relative_gap"] = certificate.relative_gap;
    dict["reached"] = certificate.reached;
    dict["reason"] = certificate.reason;
    dict["iterations"] = certificate.iterations;
    dict["nonzero_pairs"] = certificate.nonzero_pairs;
    return dict;
}

/// pybind11 wants to know the whole class of what it holds.
struct HeldModel {
    std::shared_ptr<const coseg::Model> model;
};

py::object alignment_of(const coseg::Alignment& alignment) {
    if (alignment.shapes.empty()) return py::none();
    py::list shapes;
    for (const coseg::ShapeTransform& shape : alignment.shapes) {
        py::dict row;
        row["rotation"] = shape.rotation;
        row["scale"] = shape.scale;
        row["translation"] = shape.translation;
        row["agreement"] = shape.agreement;
        row["residual"] = shape.residual;
        row["reflected"] = shape.reflected;
        row["found"] = shape.found;
        shapes.append(row);
    }
    py::dict dict;
    dict["aligned"] = alignment.aligned;
    dict["reason"] = alignment.reason;
    dict["standing_share"] = alignment.standing_share;
    dict["agreement_before"] = alignment.agreement_before;
    dict["agreement_after"] = alignment.agreement_after;
    dict["shapes"] = shapes;
    return dict;
}

py::dict dict_of(coseg::Segmentation&& result) {
    py::list shapes;
    for (coseg::ShapeLabels& shape : result.shapes) {
        py::dict row;
        row["name"] = text_of(shape.name);
        row["labels"] = array_of(std::move(shape.labels));
        row["patches"] = array_of(std::move(shape.patches));
        row["part_areas"] = array_of(std::move(shape.part_areas));
        row["warnings"] = texts_of(shape.warnings);
        row["set_aside"] = text_of(shape.set_aside);
        shapes.append(row);
    }
    py::dict dict;
    dict["parts"] = result.parts;
    dict["shapes"] = shapes;
    dict["certificate"] = dict_of(result.certificate);
    dict["warnings"] = texts_of(result.warnings);
    dict["report"] = py::bytes(result.report);
    dict["alignment"] = alignment_of(result.alignment);
    dict["model"] = py::none();
    if (result.model != nullptr) dict["model"] = HeldModel{result.model};
    return dict;
}

struct SegmentArguments {
    int parts = 0;
    std::vector<coseg::Option> options;
    bool strict = true;
    bool keep_model = true;
    std::string folder;
    bool replace = false;
    std::string state;
    std::string examples;  ///< of assign alone
};

py::dict segment(const std::vector<GivenShape>& given, const SegmentArguments& a,
                 const Communicator& communicator, const py::object& progress) {
    const std::vector<coseg::Shape> shapes = shapes_of(given);
    coseg::SegmentOptions options;
    options.parts = a.parts;
    options.options = a.options;
    options.strict = a.strict;
    options.keep_model = a.keep_model;
    options.folder = a.folder;
    options.replace = a.replace;
    options.state = a.state;
    return dict_of(in_call(communicator, progress,
                           [&](const coseg::Call& call) { return coseg::segment(shapes, options, call); }));
}

py::dict assign(const std::vector<GivenShape>& given, const HeldModel& held, const SegmentArguments& a,
                const Communicator& communicator, const py::object& progress) {
    const std::vector<coseg::Shape> shapes = shapes_of(given);
    return dict_of(in_call(communicator, progress, [&](const coseg::Call& call) {
        return coseg::assign(shapes, held.model, {a.strict, a.folder, a.replace, a.state, a.examples}, call);
    }));
}

HeldModel load_model(const std::string& folder, const Communicator& communicator) {
    return {in_call(communicator, py::none(),
                    [&](const coseg::Call& call) { return coseg::load_model(folder, call); })};
}

py::list describe(const std::vector<GivenShape>& given, const std::vector<coseg::Option>& options,
                  const Communicator& communicator, const py::object& progress) {
    const std::vector<coseg::Shape> shapes = shapes_of(given);
    std::vector<coseg::ShapeDescription> described =
        in_call(communicator, progress,
                [&](const coseg::Call& call) { return coseg::describe(shapes, options, call); });
    py::list list;
    for (coseg::ShapeDescription& shape : described) {
        const auto faces = static_cast<py::ssize_t>(shape.areas.size());
        py::dict descriptors;
        for (coseg::NamedFaceValues& one : shape.descriptors) {
            const std::vector<py::ssize_t> extent = one.dimensions == 1
                                                        ? std::vector<py::ssize_t>{faces}
                                                        : std::vector<py::ssize_t>{faces, one.dimensions};
            descriptors[py::str(one.name)] = array_of(std::move(one.values), extent);
        }
        list.append(py::make_tuple(text_of(shape.name), array_of(std::move(shape.areas)), descriptors));
    }
    return list;
}

py::dict score(const std::vector<GivenShape>& given, const std::vector<Ints>& labels,
               const std::vector<Ints>& truth) {
    const std::vector<coseg::Shape> shapes = shapes_of(given);
    const std::vector<std::vector<int>> own = vectors_of(labels);
    const std::vector<std::vector<int>> known = vectors_of(truth);
    coseg::Score found;
    {
        const py::gil_scoped_release released;
        found = coseg::score(shapes, own, known);
    }
    py::dict dict;
    dict["accuracy"] = found.accuracy;
    dict["many_to_one"] = found.many_to_one;
    dict["one_part"] = found.one_part;
    dict["rand_index"] = found.rand_index;
    py::list rows;
    for (const coseg::ScoredShape& shape : found.shapes) {
        py::dict row;
        row["accuracy"] = shape.accuracy;
        row["many_to_one"] = shape.many_to_one;
        row["rand_index"] = shape.rand_index;
        rows.append(row);
    }
    dict["shapes"] = rows;
    return dict;
}

py::tuple parts_of(coseg::SparseMatrix&& matrix) {
    return py::make_tuple(matrix.size, array_of(std::move(matrix.values)),
                          array_of(std::move(matrix.indices)), array_of(std::move(matrix.offsets)));
}

py::dict cluster(const std::vector<Doubles>& matrices, const coseg::ClusterSettings& settings,
                 const Communicator& communicator, const py::object& progress) {
    std::vector<coseg::FeatureMatrix> features;
    for (const Doubles& matrix : matrices)
        features.push_back({span_of(matrix), static_cast<int>(matrix.ndim() == 2 ? matrix.shape(1) : 1)});
    coseg::Clusters found = in_call(communicator, progress, [&](const coseg::Call& call) {
        return coseg::cluster(features, settings, call);
    });
    py::list coefficients;
    for (coseg::SparseMatrix& matrix : found.coefficients) coefficients.append(parts_of(std::move(matrix)));
    py::dict dict;
    dict["labels"] = array_of(std::move(found.labels));
    dict["certificate"] = dict_of(found.certificate);
    dict["report"] = py::bytes(found.report);
    dict["coefficients"] = coefficients;
    dict["affinity"] = parts_of(std::move(found.affinity));
    return dict;
}

py::tuple tuple_of(coseg::Mesh&& mesh) {
    const auto vertices = static_cast<py::ssize_t>(mesh.vertices.size() / 3);
    return py::make_tuple(array_of(std::move(mesh.vertices), {vertices, 3}),
                          array_of(std::move(mesh.corners)), array_of(std::move(mesh.offsets)));
}

py::list generate(const std::string& family, int count, std::uint64_t seed, int faces) {
    std::vector<coseg::GeneratedShape> shapes;
    {
        const py::gil_scoped_release released;
        shapes = coseg::generate(family, count, seed, faces, [](int /*number*/) {
            const py::gil_scoped_acquire held;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // Ctrl-C
        });
    }
    py::list list;
    for (coseg::GeneratedShape& shape : shapes)
        list.append(
            py::make_tuple(shape.name, tuple_of(std::move(shape.mesh)), array_of(std::move(shape.labels))));
    return list;
}

/// On which the processes that share work wait for each other before they end; nothing else is said on it.
MPI_Comm leaving = MPI_COMM_NULL;
bool has_left = false;

/// Waits until all processes have come here or have been here; at most so many seconds, unless that is
/// negative. Whether they have.
bool leave_together(double seconds) {
    int is_finalized = 0;
    MPI_Finalized(&is_finalized);
    if (has_left || is_finalized != 0) return true;
    has_left = true;
    const auto begin = std::chrono::steady_clock::now();
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(leaving, &request);
    while (true) {
        int is_done = 0;
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        if (is_done != 0) return true;
        const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
        if (seconds >= 0.0 && waited.count() > seconds) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

/// Where all processes fail alike, they come to their ends within this time.
constexpr double seconds_to_fail_together = 5.0;

/// A process that fails alone does not leave the others waiting for ever.
void leave_failed() {
    if (!leave_together(seconds_to_fail_together)) MPI_Abort(MPI_COMM_WORLD, 1);
}

/// The interpreter tells nobody with what code it ends. The C library does, when the interpreter is gone and
/// MPI still there, however the script has ended: sys.exit, SystemExit or an exception.
void leave_at_exit(int code, void* started_by) {
    if (::getpid() != static_cast<pid_t>(reinterpret_cast<std::intptr_t>(started_by))) return;  // forked
    if (code == 0)
        leave_together(-1.0);
    else
        leave_failed();
}

/// The handle of MPI_COMM_WORLD, for scripts that mpirun starts and that have no mpi4py. Collective the first
/// time.
int world() {
    coseg::start();
    if (leaving == MPI_COMM_NULL) {
        MPI_Comm_dup(MPI_COMM_WORLD, &leaving);
        ::on_exit(leave_at_exit, reinterpret_cast<void*>(static_cast<std::intptr_t>(::getpid())));
    }
    return static_cast<int>(MPI_Comm_c2f(MPI_COMM_WORLD));
}

void add_arguments(py::module_& module) {
    py::class_<SegmentArguments>(module, "SegmentArguments")
        .def(py::init<>())
        .def_readwrite("parts", &SegmentArguments::parts)
        .def_readwrite("options", &SegmentArguments::options)
        .def_readwrite("strict", &SegmentArguments::strict)
        .def_readwrite("keep_model", &SegmentArguments::keep_model)
        .def_readwrite("folder", &SegmentArguments::folder)
        .def_readwrite("replace", &SegmentArguments::replace)
        .def_readwrite("state", &SegmentArguments::state)
        .def_readwrite("examples", &SegmentArguments::examples);
    using Settings = coseg::ClusterSettings;
    py::class_<Settings>(module, "ClusterSettings")
        .def(py::init<>())
        .def_readwrite("parts", &Settings::parts)
        .def_readwrite("groups", &Settings::groups)
        .def_readwrite("unit_items", &Settings::unit_items)
        .def_readwrite("alpha", &Settings::alpha)
        .def_readwrite("beta", &Settings::beta)
        .def_readwrite("lambda_", &Settings::lambda)
        .def_readwrite("variant", &Settings::variant)
        .def_readwrite("scope", &Settings::scope)
        .def_readwrite("affinity", &Settings::affinity)
        .def_readwrite("links", &Settings::links)
        .def_readwrite("seed", &Settings::seed)
        .def_readwrite("gap", &Settings::gap)
        .def_readwrite("max_iterations", &Settings::max_iterations)
        .def_readwrite("max_seconds", &Settings::max_seconds);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
    module.attr("automatic_parts") = coseg::automatic_parts;
    module.doc() = "The interface of coseg for C++; see the package coseg for what is meant for users.";
    // Failure(code, sentence): the Python side makes it its own exception.
    static const py::exception<coseg::Failure> failure(module, "Failure");
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const coseg::Failure& error) {
            PyErr_SetObject(failure.ptr(), py::make_tuple(error.code(), text_of(error.what())).ptr());
        }
    });
    py::class_<HeldModel>(module, "Model");
    add_arguments(module);
    module.def("version", &coseg::version);
    module.def("option_names", &coseg::option_names);
    module.def("option_kinds", &coseg::option_kinds);
    module.def("mesh_files", [](const std::vector<std::string>& arguments) {
        return texts_of(with_interpreter_free([&] { return coseg::mesh_files(arguments); }));
    });
    module.def("changed_files", [](const std::string& folder) {
        return texts_of(with_interpreter_free([&] { return coseg::changed_files(folder); }));
    });
    module.def("load_mesh", [](const std::string& path) {
        return tuple_of(with_interpreter_free([&] { return coseg::load_mesh(path); }));
    });
    module.def("generate", &generate);
    module.def("load_model", &load_model);
    module.def("segment", &segment);
    module.def("assign", &assign);
    module.def("describe", &describe);
    module.def("score", &score);
    module.def("cluster", &cluster);
    module.def("start", &coseg::start);
    module.def("world", &world);
    module.def("leave_together", &leave_together, py::call_guard<py::gil_scoped_release>());
    module.def("leave_failed", &leave_failed, py::call_guard<py::gil_scoped_release>());
}
