#pragma once
// The part of the interface that reads files, generates shapes and compares labels, for which nothing of
// PETSc and SLEPc is needed: a program that uses nothing else links coseg::io. <coseg/coseg.hpp> includes it
// and has the rest. Every failure is an exception of type Failure, nothing is printed, and no process is
// ended. No function is collective.

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

/// Goes up with every change after which programs that were written for an earlier one must be changed.
#define COSEG_INTERFACE_VERSION 1
/// What others may see of a library in which this one is contained.
#define COSEG_VISIBLE __attribute__((visibility("default")))

namespace coseg {
inline namespace interface_1 {

/// The version of the library, as "0.1.0".
COSEG_VISIBLE std::string version();

/// A sentence that names the shape, face, file or option and says what to do, and one of these codes:
/// 1 internal, 2 usage (an option, an argument), 3 input (a mesh, a matrix), 4 output (a folder that cannot
/// be written), 5 no convergence, 75 ended by a signal with its state written.
class COSEG_VISIBLE Failure : public std::runtime_error {
  public:
    Failure(int code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
    [[nodiscard]] int code() const noexcept { return code_; }

  private:
    int code_;
};

// ---- Shapes ----

/// A mesh in memory. Nothing is required of its geometry: polygons, seams, non-manifold edges and degenerate
/// faces are repaired inside the program, and every face keeps its place.
struct Mesh {
    std::vector<double> vertices;  ///< 3 V: x, y and z of each vertex, in any unit
    std::vector<int> corners;      ///< vertex numbers from 0, one face after the other
    std::vector<int> offsets;      ///< F + 1: face f is corners[offsets[f]] .. corners[offsets[f + 1] - 1]
};

/// A shape of a collection: a mesh file, or a mesh in the memory of the caller.
struct Shape {
    /// What all randomness of the shape is drawn by, and the name of its files. Unique in a collection,
    /// without '/'. Empty: the file's name without folder and suffix; of the mesh with index 7 "shape_0007".
    std::string name;
    std::string path;                  ///< of a mesh file; empty: the arrays below hold the mesh
    std::span<const double> vertices;  ///< as in Mesh
    std::span<const int> corners;      ///< likewise
    std::span<const int> offsets;      ///< likewise; empty where every face is a triangle
};

/// A shape that refers to `mesh`, which must outlive it.
COSEG_VISIBLE Shape shape_of(const Mesh& mesh, const std::string& name = "");
COSEG_VISIBLE Shape shape_of(const std::string& path);

/// The mesh of a file in a format that `coseg run` reads, with as many faces as the file has, in its order.
/// Failure: 3.
COSEG_VISIBLE Mesh load_mesh(const std::string& path);

/// The mesh files that are meant by files, folders and lists (`@` and a path), sorted by name, as `coseg run`
/// takes them. Failure: 3.
COSEG_VISIBLE std::vector<std::string> mesh_files(const std::vector<std::string>& arguments);

/// A shape with known parts, as `coseg generate` makes them.
struct GeneratedShape {
    std::string name;         ///< table_0002
    Mesh mesh;                ///< closed triangles, about one unit in size, z up
    std::vector<int> labels;  ///< F: the true label of each face
};

/// The shapes 0 .. count - 1 of the endless collection that a family (`coseg generate list`) and a seed give,
/// each with about so many faces (500 .. 200000). Failure: 2.
COSEG_VISIBLE std::vector<GeneratedShape> generate(const std::string& family, int count,
                                                   std::uint64_t seed = 1, int faces = 5000);

/// The same; `before_each` is called with the number of every shape before it is made, and what it throws
/// ends the call.
COSEG_VISIBLE std::vector<GeneratedShape> generate(const std::string& family, int count, std::uint64_t seed,
                                                   int faces, const std::function<void(int)>& before_each);

// ---- Finished runs ----

/// The files of a finished run, report.json and label files, that are not as the run wrote them: damaged, or
/// edited, which is the user's right. A sentence each. Failure: 3 where report.json cannot be
/// used.
COSEG_VISIBLE std::vector<std::string> changed_files(const std::string& folder);

// ---- Scores ----

/// Shares in [0, 1].
struct ScoredShape {
    double accuracy = 0.0;     ///< area of faces whose part stands for their true label
    double many_to_one = 0.0;  ///< the same if each part takes the label that covers most of its area
    double rand_index = 0.0;   ///< by area
};

struct Score {
    double accuracy = 0.0;     ///< mean over shapes, with one assignment of parts to labels for all of them
    double many_to_one = 0.0;  ///< likewise
    double one_part = 0.0;     ///< the accuracy of one single part for everything: the figure to beat
    double rand_index = 0.0;
    std::vector<ScoredShape> shapes;
};

/// Compares labels with the truth, as `coseg score` does. labels, truth: for each shape F numbers; the two
/// numberings are independent of each other, and negative truth never counts as right. Empty labels score 0.
/// Failure: 3 where numbers of shapes or faces differ.
COSEG_VISIBLE Score score(std::span<const Shape> shapes, const std::vector<std::vector<int>>& labels,
                          const std::vector<std::vector<int>>& truth);

}  // namespace interface_1
}  // namespace coseg
