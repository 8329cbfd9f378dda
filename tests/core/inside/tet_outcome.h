#ifndef bindpose_tests_core_inside_tet_outcome_h
#define bindpose_tests_core_inside_tet_outcome_h

// Shared functions of the tests of tetrahedralize(): run it, and check the invariants of its
// result.

#include "inside/tetrahedralize.h"

#include "support/needs_mesher.h"

#include <string>
#include <vector>

namespace bindpose::test
{

struct TetOutcome
{
  TetrahedralizeResult result;
  Status status;
  double number(const char* key) const { return this->status.report.number(key, -1.0); }
  std::string method() const { return this->status.report.text("method"); }
  double volume() const
  {
    return tet_volumes(this->result.mesh.points, this->result.mesh.tets).sum();
  }
};

TetOutcome run(const TriangleMesh& mesh, TetrahedralizeOptions options = {}, int threads = 0);
TetOutcome run(const TriangleMesh& mesh, TetMethod method);

/// Expect the properties that the result of every method must have.
void expect_valid(const TetOutcome& outcome, const TriangleMesh& surface);

/// Return the given points as point handles.
HandleElements handle_elements_of(const std::vector<Vec3>& points);

/// Fixture of the tests of method cdt (constrained Delaunay tetrahedralization).
class Cdt : public MesherTest
{
};

} // namespace bindpose::test

#endif
