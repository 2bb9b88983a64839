// verify.hpp - writes a part, and judges it by the files it was written to.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fabricate/parts.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// One material of a part, as it was written.
struct WrittenMaterial {
  std::string name;
  double density = 1;          ///< g/cm^3
  std::filesystem::path file;  ///< of several materials in one file, one object each, the same
  std::size_t triangles = 0;   ///< as read again
  double grams = 0;            ///< of the file's own volume; 0 where it is no solid
  Eigen::Affine3d laid = Eigen::Affine3d::Identity();  ///< from model coordinates to the file's
  /// What was added to them because single precision would not hold the part where the model is; in `laid`.
  Vec3 moved = Vec3::Zero();
};

/// What the written files hold.
struct WrittenPart {
  std::vector<WrittenMaterial> materials;
  Moments moments = Moments::Zero();  ///< body frame and units
  Verdict verdict;
};

/// A file each: part or shell as `path` says, the others as NAME-interior.stl, NAME-filling.stl or
/// NAME-upper.stl beside it, where they are laid. 3MF takes them all in one file, as objects with their
/// names.
///
/// A part far from the origin stays there where the format's numbers hold it (Precision): where neighbouring
/// ones are no more than 1e-5 of its length and 0.4 um apart, a thousandth of what printers can do, and none
/// of its triangles run through each other once rounded. Else all parts are moved to about the origin.
/// @throws InputError  see write_mesh()
[[nodiscard]] std::vector<WrittenMaterial> write_parts(const std::filesystem::path& path,
                                                       const std::vector<MaterialPart>& parts);

/// A surface of the part as the numbers of its file hold it, or those of single precision near the part where
/// there is no file; model coordinates.
[[nodiscard]] TriangleMesh as_written(const WrittenMaterial& material, TriangleMesh mesh, const Vec3& place);

/// Where a part of that name goes. @throws InputError  no mesh format
[[nodiscard]] std::filesystem::path file_of_part(const std::filesystem::path& path, std::string_view name);

/// Reads written parts in their order, each file once.
class WrittenReader {
 public:
  /// The next part where it belongs, model coordinates, with vertices of its own where parts of its surface
  /// merely touch; says of `material` how many triangles it has.
  /// @throws InputError  a file that cannot be read, or holds no more
  [[nodiscard]] TriangleMesh next(WrittenMaterial& material);

 private:
  std::filesystem::path open_;
  std::vector<TriangleMesh> objects_;
  std::size_t next_ = 0;
};

/// Reads the files again, checks that each is a watertight, oriented solid that does not run through itself,
/// integrates its moments on the host in double (not by the kernels that made it), adds them up by their
/// densities and asks the problem for its verdict. A mesh that fails the checks gives a verdict that is not
/// ok and says why.
[[nodiscard]] WrittenPart verify_written(std::vector<WrittenMaterial> materials, const Body& body,
                                         const Problem& problem);

/// The same of a part that is not written: as a file in single precision would hold it.
[[nodiscard]] WrittenPart verify_made(const std::vector<MaterialPart>& parts, const Body& body,
                                      const Problem& problem);

}  // namespace kreisel::core
