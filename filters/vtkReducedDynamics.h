/**
 * @class   vtkReducedDynamics
 * @brief   poses a mesh as a body with mass: parts that handles do not constrain swing and fall
 *
 * Dynamics in the space of vtkReducedARAP (Jacobson et al. 2012). Handles in mode `full` and
 * `position` prescribe motion. Inertia, Gravity and the shape's resistance to deformation determine
 * the rest. A time step uses implicit Euler and costs about as much as a solve of vtkReducedARAP.
 * It is stable for any TimeStep; longer steps damp oscillations more. If a handle changes to mode
 * `free`, it stops constraining the body, and the body keeps its velocity.
 *
 * **Time.** The filter provides the time steps 0, TimeStep, …, NumberOfSteps * TimeStep to the
 * pipeline, and requests the handles at the time of each step. (vtkPoseHandles returns the frame of
 * a sequence, or the value of expressions, at that time.) At time 0 the body has the pose of
 * vtkReducedARAP and no velocity. If the last simulated step is earlier than the requested time and
 * no input has changed, the simulation continues from that step. Otherwise it starts at time 0. The
 * result for a time has the same bits in both cases. If no time is requested, the output is the
 * step with index Step.
 *
 * With Interactive on, the filter ignores the pipeline's time: every execution computes one step
 * with the current handles. Restart() returns to time 0.
 *
 * Ports, arrays, bind cache and errors: see vtkPoseAlgorithm; meshes and energies: see
 * vtkReducedARAP.
 *
 * Report: the entries of vtkReducedARAP for the last step, energy (of the deformation),
 * kinetic_energy, time, steps. The status is NOT_CONVERGED, with an output, if Tolerance was not
 * reached within MaximumIterations in the last step.
 *
 * @sa vtkReducedARAP
 */

#ifndef vtkReducedDynamics_h
#define vtkReducedDynamics_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkReducedPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkReducedDynamics : public vtkReducedPoseAlgorithm
{
public:
  static vtkReducedDynamics* New();
  vtkTypeMacro(vtkReducedDynamics, vtkReducedPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Length of a time step in seconds, above 0. Default 1/24.
  void SetTimeStep(double seconds);
  vtkGetMacro(TimeStep, double);
  ///@}

  ///@{
  /// Number of steps that are provided as the pipeline's time steps, 0 to 1e7. Default 100.
  vtkSetClampMacro(NumberOfSteps, int, 0, 10000000);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  ///@{
  /// Index of the time step that is output if no time is requested, 0 to 1e7. Default 0.
  vtkSetClampMacro(Step, int, 0, 10000000);
  vtkGetMacro(Step, int);
  ///@}

  ///@{
  /// Acceleration by gravity, in length units per second squared. Default 0, 0, 0.
  void SetGravity(double x, double y, double z);
  void SetGravity(const double gravity[3]);
  vtkGetVector3Macro(Gravity, double);
  ///@}

  ///@{
  /// Mass per volume (for surfaces per area), above 0. Default 1.
  void SetDensity(double density);
  vtkGetMacro(Density, double);
  ///@}

  ///@{
  /**
   * Resistance to bending, above 0. A strain e has the energy stiffness * e^2 / 2 per volume (per
   * area for surfaces).
   * Default 1000. Waves travel at sqrt(Stiffness / Density) length units per second. With gravity
   * g, a limb of length l sags by about Density g l^2 / Stiffness.
   */
  void SetStiffness(double stiffness);
  vtkGetMacro(Stiffness, double);
  ///@}

  ///@{
  /// Drag coefficient in 1 / s, >= 0: the drag force is coefficient times mass times velocity.
  /// Default 0.
  void SetDamping(double damping);
  vtkGetMacro(Damping, double);
  ///@}

  ///@{
  /// Maximum number of iterations per step, 1 to 1e6. Default 50.
  void SetMaximumIterations(int iterations);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /// Convergence tolerance: a step ends when an iteration lowers the minimized function by no more
  /// than this fraction of its value. Default 1e-6; 0 runs all iterations.
  void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// See vtkReducedARAP::SetMixedPrecision; used in each step. Default on.
  void SetMixedPrecision(bool mixed);
  vtkGetMacro(MixedPrecision, bool);
  vtkBooleanMacro(MixedPrecision, bool);
  ///@}

  ///@{
  /// Compute one step per execution and ignore the pipeline's time; see Time in the class
  /// documentation. Default off.
  void SetInteractive(bool interactive);
  vtkGetMacro(Interactive, bool);
  vtkBooleanMacro(Interactive, bool);
  ///@}

  /// Make the next execution start at time 0.
  void Restart();

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

protected:
  vtkReducedDynamics();
  ~vtkReducedDynamics() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;
  bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) override;
  /// Return false, because the points depend on the previous time steps, not only on the pose.
  bool CanPosePoints() override { return false; }
  bindpose::Status Deform(bindpose::ExecutionContext& context, const bindpose::PoseInput& input,
    bindpose::PosedPoints& posed) override;
  bindpose::Status DeformNormals(bindpose::ExecutionContext& context,
    const bindpose::PoseInput& input, const bindpose::PosedPoints& posed,
    bindpose::PosedPoints& normals) override;

private:
  vtkReducedDynamics(const vtkReducedDynamics&) = delete;
  void operator=(const vtkReducedDynamics&) = delete;

  template <typename Value>
  void SetMotionParameter(Value& parameter, const Value& value)
  {
    if (parameter != value)
    {
      parameter = value;
      this->Restart();
    }
  }

  double TimeStep = 1.0 / 24.0;
  int NumberOfSteps = 100;
  int Step = 0;
  double Gravity[3] = { 0.0, 0.0, 0.0 };
  double Density = 1.0;
  double Stiffness = 1000.0;
  double Damping = 0.0;
  int MaximumIterations = 50;
  double Tolerance = 1e-6;
  bool MixedPrecision = true;
  bool Interactive = false;
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
