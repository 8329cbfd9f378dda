// Reduced dynamics by implicit Euler steps. For the mass matrix M, the displacement D_n and the
// velocity V_n, the next displacement D minimizes
//
//     E(D) + u / (2 h^2) |D - D_n - h V_n|^2_M + u c / (2 h) |D - D_n|^2_M - u <M g, D>,
//
// where u = density / stiffness, h is the time step, c is the damping and g is the gravity.
// Therefore the quadratic form L of the energy is replaced by L + u (1 / h^2 + c / h) M, and the
// other terms are a load. A constant is added to the energies of the solver. Without the constant,
// the energies would contain the square of the distance that the body has moved since the start.
// With the constant, they contain only the deformation energy and small terms.
#include "arap/reduced_dynamics.h"

#include "pose/rotation_fit.h"

#include <cmath>

namespace bindpose
{

namespace
{
double product(const ReducedDynamics::Rows& a, const ReducedDynamics::Rows& b)
{
  return (a.array() * b.array()).sum();
}
} // namespace

Status check_options(const ReducedDynamicsOptions& options)
{
  const auto positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!positive(options.time_step))
  {
    return Status::invalid_input("the time step must be greater than 0");
  }
  if (!positive(options.density) || !positive(options.stiffness))
  {
    return Status::invalid_input("density and stiffness must be greater than 0");
  }
  if (!std::isfinite(options.damping) || options.damping < 0.0)
  {
    return Status::invalid_input("the damping must be at least 0");
  }
  if (!options.gravity.allFinite())
  {
    return Status::invalid_input("the gravity has a component that is not finite");
  }
  return {};
}

template <typename Elements>
Status ReducedDynamics::bind_elements(ExecutionContext& context, PointsView points,
  const Elements& elements, WeightsView weights, const Handles& handles, ReducedArapOptions options)
{
  *this = ReducedDynamics();
  options.mass = true;
  const Status status = this->space_.bind(context, points, elements, weights, handles, options);
  if (status.usable())
  {
    const ReducedSpace& space = this->space_;
    this->state_.displacement = this->state_.velocity = Rows::Zero(4 * space.columns, 3);
    this->state_.transforms.assign(static_cast<std::size_t>(space.columns), identity_affine());
    this->state_.rotations.assign(static_cast<std::size_t>(9 * space.stride), 0.0);
    for (Index e = 0; e < 9; e += 4)
    {
      std::fill_n(this->state_.rotations.begin() + e * space.stride, space.groups.count, 1.0);
    }
  }
  return status;
}

Status ReducedDynamics::bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
  WeightsView weights, const Handles& handles, const ReducedArapOptions& options)
{
  return this->bind_elements(context, points, triangles, weights, handles, options);
}

Status ReducedDynamics::bind(ExecutionContext& context, PointsView points, TetsView tets,
  WeightsView weights, const Handles& handles, const ReducedArapOptions& options)
{
  return this->bind_elements(context, points, tets, weights, handles, options);
}

Status ReducedDynamics::start(
  ExecutionContext& context, const Pose& pose, const ReducedSolveOptions& options)
{
  const Rows zero_load = Rows::Zero(4 * this->space_.columns, 3);
  ReducedSolver solver;
  ReducedSolveOptions from_guess = options;
  from_guess.start = ReducedStart::guess;
  Rows d;
  Status status =
    solver.solve(context, this->space_, { this->space_.stiffness, zero_load }, pose, from_guess, d);
  if (status.usable())
  {
    this->state_.time = 0.0;
    this->state_.steps = 0;
    this->state_.displacement = d;
    this->state_.velocity = zero_load;
    this->state_.rotations = solver.rotations();
    this->state_.transforms = this->space_.transforms_of(d, pose);
  }
  return status;
}

Status ReducedDynamics::step(
  ExecutionContext& context, const Pose& pose, const ReducedDynamicsOptions& options)
{
  Status status = check_options(options);
  if (!status.ok())
  {
    return status;
  }
  const ReducedSpace& space = this->space_;
  State& state = this->state_;
  const double scale = space.frame.scale();
  const double h = options.time_step;
  const double unit = options.density / options.stiffness / (scale * scale);
  const double inertia = unit / (h * h), drag = unit * options.damping / h;
  if (this->inertia_ != inertia + drag)
  {
    this->inertia_ = inertia + drag;
    this->system_ = space.stiffness + this->inertia_ * space.mass;
    this->solver_.reset();
  }
  const Rows& displacement = state.displacement;
  const Rows coasting = displacement + h * state.velocity;
  const Rows weight = unit * space.mass_sums * (scale * options.gravity).transpose();
  const Rows inertial = space.mass * (inertia * coasting + drag * displacement);
  const Rows load = inertial + weight;
  const double constant = 0.5 * inertia * product(coasting, space.mass * coasting) +
    0.5 * drag * product(displacement, space.mass * displacement) + product(weight, coasting);
  ReducedSolveOptions solve = options.solve;
  solve.start = ReducedStart::last;
  this->solver_.set_rotations(state.rotations);
  Rows d;
  status = this->solver_.solve(context, space, { this->system_, load, constant }, pose, solve, d);
  if (!status.usable())
  {
    return status;
  }
  state.velocity = (d - displacement) / h;
  state.displacement = d;
  state.rotations = this->solver_.rotations();
  state.transforms = space.transforms_of(d, pose);
  state.steps += 1;
  state.time += h;
  status.report.set(
    "energy", Report::Value(options.stiffness * std::max(this->elastic_energy(), 0.0)));
  status.report.set("kinetic_energy", Report::Value(options.density * this->kinetic_energy()));
  status.report.set("time", Report::Value(state.time));
  return status;
}

Status ReducedDynamics::deform(ExecutionContext& context, PointsView rest, PointsOutput posed) const
{
  return this->space_.skinning.linear_blend(context, rest, this->state_.transforms, posed);
}

Status ReducedDynamics::deform_normals(
  ExecutionContext& context, PointsView rest_normals, PointsOutput posed_normals) const
{
  return this->space_.skinning.linear_blend_normals(
    context, rest_normals, this->state_.transforms, posed_normals);
}

std::vector<Eigen::Matrix3d> ReducedDynamics::rotations() const
{
  return rotation_matrices(this->space_.groups.count, this->space_.stride, this->state_.rotations);
}

double ReducedDynamics::elastic_energy() const
{
  const ReducedSpace& space = this->space_;
  const Rows& d = this->state_.displacement;
  const Rows moved = space.covariance * d;
  double rotated_energy = 0.0;
  for (Index i = 0; i < 3; ++i)
  {
    for (Index j = 0; j < 3; ++j)
    {
      for (Index k = 0; k < space.groups.count; ++k)
      {
        // Entry (i, j) of S is multiplied by entry (j, i) of the rotations.
        const double q = this->state_.rotations[(3 * j + i) * space.stride + k] - (i == j ? 1 : 0);
        rotated_energy += q *
          (space.rest_covariance[(3 * i + j) * space.stride + k] +
            moved(i * space.groups.count + k, j));
      }
    }
  }
  return 0.5 * product(d, space.stiffness * d) - rotated_energy;
}

double ReducedDynamics::kinetic_energy() const
{
  return 0.5 * product(this->state_.velocity, this->space_.mass * this->state_.velocity);
}

Vec3 ReducedDynamics::momentum() const
{
  return this->state_.velocity.transpose() * this->space_.mass_sums;
}

} // namespace bindpose
