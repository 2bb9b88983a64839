// problem.cpp - problems written in Python.
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <kreisel/problem.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "question.hpp"
#include "registered.hpp"

namespace kreisel::python {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// An object with the methods of kreisel.Problem. The solvers call it without the GIL, which each call takes.
class Foreign {
 public:
  explicit Foreign(py::object object) : object_(std::move(object)) {}
  ~Foreign() {
    const py::gil_scoped_acquire held;
    object_ = py::object();
  }
  Foreign(const Foreign&) = delete;
  Foreign& operator=(const Foreign&) = delete;

  /// @throws InputError  an answer of another type or shape
  template <class T, class... Arguments>
  [[nodiscard]] T call(const char* method, const char* expected, const Arguments&... arguments) const {
    const py::gil_scoped_acquire held;
    return value_of<T>(method, object_.attr(method)(arguments...), expected);
  }
  [[nodiscard]] py::object get(const char* attribute) const { return object_.attr(attribute); }

 private:
  py::object object_;
};

class ForeignRows final : public Nonlinear {
 public:
  /// @param limits  (lower, upper) of each row
  ForeignRows(const Foreign& object, std::string name, const std::vector<std::pair<double, double>>& limits)
      : object_(object), name_(std::move(name)), lower_(limits.size()), upper_(limits.size()) {
    for (std::size_t i = 0; i < limits.size(); ++i) {
      lower_[static_cast<Eigen::Index>(i)] = limits[i].first;
      upper_[static_cast<Eigen::Index>(i)] = limits[i].second;
    }
  }
  [[nodiscard]] std::string asked_by() const override {
    return "the nonlinear rows of problem '" + name_ + "'";
  }
  [[nodiscard]] double value(const Moments& s, const Vector&) const override {
    return object_.call<double>("value", "a number", s);
  }
  [[nodiscard]] Vector gradient(const Moments& s, const Vector&) const override {
    return object_.call<Moments>("gradient", "(10,)", s);
  }
  [[nodiscard]] Matrix hessian(const Moments& s, const Vector&) const override {
    return object_.call<Matrix10>("hessian", "(10, 10)", s);
  }
  [[nodiscard]] const Vector& lower() const override { return lower_; }
  [[nodiscard]] const Vector& upper() const override { return upper_; }
  [[nodiscard]] Vector rows(const Moments& s, const Vector&) const override {
    Vector rows = object_.call<Vector>("nonlinear", "one number a row of limits", s);
    if (rows.size() != lower_.size())
      throw InputError("nonlinear: " + std::to_string(rows.size()) +
                       " numbers; expected one a row of limits, " + std::to_string(lower_.size()));
    return rows;
  }
  [[nodiscard]] Matrix jacobian(const Moments& s, const Vector&) const override {
    return shaped(object_.call<Matrix>("jacobian", "(rows, 10)", s), lower_.size(), "jacobian");
  }
  [[nodiscard]] Matrix curvature(const Moments& s, const Vector&, const Vector& multipliers) const override {
    return shaped(object_.call<Matrix>("curvature", "(10, 10)", s, multipliers), 10, "curvature");
  }

 private:
  [[nodiscard]] static Matrix shaped(Matrix m, Eigen::Index rows, const char* what) {
    if (m.rows() != rows || m.cols() != 10)
      throw InputError(std::string(what) + " of shape " + std::to_string(m.rows()) + " x " +
                       std::to_string(m.cols()) + "; expected " + std::to_string(rows) + " x 10");
    return m;
  }

  const Foreign& object_;
  std::string name_;
  Vector lower_, upper_;
};

class ForeignProblem final : public Problem {
 public:
  /// With the GIL.
  ForeignProblem(py::object object, std::string name) : name_(std::move(name)), object_(std::move(object)) {
    using Row = std::tuple<std::string, Moments, double, double>;
    const auto rows =
        value_of<std::vector<Row>>("rows", object_.get("rows"), "(name, (10,), lower, upper) each");
    const auto n = static_cast<Eigen::Index>(rows.size());
    constraints_.matrix.resize(n, 10);
    constraints_.lower.resize(n);
    constraints_.upper.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& [row, form, lower, upper] = rows[static_cast<std::size_t>(i)];
      constraints_.names.push_back(row);
      constraints_.matrix.row(i) = form.transpose();
      constraints_.lower[i] = lower;
      constraints_.upper[i] = upper;
    }
    const auto limits = value_of<std::vector<std::pair<double, double>>>("limits", object_.get("limits"),
                                                                         "(lower, upper) each");
    if (!limits.empty()) nonlinear_ = std::make_unique<ForeignRows>(object_, name_, limits);
  }
  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] double value(const Moments& s) const override {
    return object_.call<double>("value", "a number", s);
  }
  [[nodiscard]] Moments gradient(const Moments& s) const override {
    return object_.call<Moments>("gradient", "(10,)", s);
  }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override {
    return object_.call<Matrix10>("hessian", "(10, 10)", s);
  }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] const Nonlinear* nonlinear() const override { return nonlinear_.get(); }
  [[nodiscard]] double pose_loss(const Moments& s) const override {
    return object_.call<double>("pose_loss", "a number", s);
  }
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override {
    const auto [ok, text] =
        object_.call<std::pair<bool, std::string>>("verify", "(ok, a sentence)", s, length_mm);
    return {ok, text, {}};
  }

 private:
  std::string name_;
  Foreign object_;
  LinearConstraints constraints_;
  std::unique_ptr<ForeignRows> nonlinear_;
};

/// The body in arrays of its own: what Python keeps of it may outlive it.
py::object copied(const PosedBody& body) {
  const py::tuple mesh = views_of(body.mesh, py::none());
  return py::module_::import("types").attr("SimpleNamespace")(
      py::arg("vertices") = mesh[0].attr("copy")(), py::arg("faces") = mesh[1].attr("copy")(),
      py::arg("rotation") = body.rotation, py::arg("origin") = body.origin,
      py::arg("length_mm") = body.length_mm, py::arg("solid") = body.solid,
      py::arg("density") = body.density);
}

}  // namespace

void add_problems(py::module_& m) {
  m.def(
      "add_problem",
      [](const std::string& name, const py::function& make, const std::string& summary, bool upright,
         bool centred, const std::string& poses) {
        const std::map<std::string, Poses> kinds = {
            {"none", Poses::none}, {"any", Poses::any}, {"rest", Poses::rest}};
        if (!kinds.contains(poses))
          throw InputError("add_problem: poses = '" + poses + "'; expected none, any or rest");
        // Kept for good: the registry outlives the interpreter, which must not be asked to let go of it then.
        const py::handle kept = make.inc_ref();
        add_problem({name, summary,
                     [kept, name](const std::map<std::string, std::string>& settings,
                                  const PosedBody& body) -> std::unique_ptr<Problem> {
                       const py::gil_scoped_acquire held;
                       return std::make_unique<ForeignProblem>(kept(settings, copied(body)), name);
                     },
                     upright, centred, kinds.at(poses)});
      },
      py::arg("name"), py::arg("make"), py::kw_only(), py::arg("summary") = "", py::arg("upright") = false,
      py::arg("centred") = false, py::arg("poses") = "none",
      "Makes a problem known by its name. make(settings, body) returns an object with the methods of "
      "Problem; "
      "settings are those of `problem.NAME`, as text; body has vertices, faces, rotation, origin, length_mm, "
      "solid "
      "(moments in the body frame) and density. poses: what `find` may choose, none, any direction, or those "
      "in which "
      "the body comes to rest. Before the first session that asks for it.");
}

}  // namespace kreisel::python
