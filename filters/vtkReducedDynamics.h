/**
 * @class   vtkReducedDynamics
 * @brief   poses a mesh as a body with mass: what handles leave open swings and falls
 *
 * Dynamics in the space of vtkReducedARAP (Jacobson et al. 2012): handles in mode `full` and
 * `position` lead, all else follows its inertia, Gravity and the shape's wish to be rigid. A step
 * is implicit Euler and takes about what a solve of vtkReducedARAP takes; it is stable however long
 * TimeStep is, and longer steps damp swings more. A handle that changes to mode `free` lets go: the
 * body keeps its velocity.
 *
 * **Time.** The filter is a source of time: it offers the time steps 0, TimeStep, …,
 * NumberOfSteps * TimeStep, and asks its input of handles for the time of each step (vtkPoseHandles
 * gives the frame of a sequence, or the value of expressions, at that time). At time 0 the body is
 * where vtkReducedARAP puts it, without velocity. What is asked for is simulated from the start, or
 * from the last step if that was earlier and nothing has changed since: the same time gives the
 * same bits. Who asks for no time gets Step.
 *
 * With Interactive on the pipeline's time does not matter: every execution is one step with the
 * handles as they are then, until Restart().
 *
 * Ports, arrays, bind cache and errors: vtkPoseAlgorithm; meshes and energies: vtkReducedARAP.
 *
 * Report: what vtkReducedARAP reports of its last step, energy (what the body is bent by),
 * kinetic_energy, time, steps. Status NOT_CONVERGED, with an output, when MaximumIterations were
 * not enough for Tolerance in the last step.
 *
 * @sa vtkReducedARAP
 */

#ifndef vtkReducedDynamics_h
#define vtkReducedDynamics_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkReducedDynamics : public vtkPoseAlgorithm
{
public:
  static vtkReducedDynamics* New();
  vtkTypeMacro(vtkReducedDynamics, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// As vtkReducedARAP's, all bind parameters.
  void SetEnergy(int energy);
  vtkGetMacro(Energy, int);
  void SetNumberOfClusters(int clusters);
  vtkGetMacro(NumberOfClusters, int);
  void SetNumberOfExtraWeights(int extra);
  vtkGetMacro(NumberOfExtraWeights, int);
  void SetExtraWeightsKind(int kind);
  vtkGetMacro(ExtraWeightsKind, int);
  ///@}

  ///@{
  /// Seconds of a step, above 0. Default 1/24.
  void SetTimeStep(double seconds);
  vtkGetMacro(TimeStep, double);
  ///@}

  ///@{
  /// Steps that are offered as the pipeline's time steps, 0 to 1e7. Default 100.
  vtkSetClampMacro(NumberOfSteps, int, 0, 10000000);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  ///@{
  /// The step that who asks for no time gets, 0 to 1e7. Default 0.
  vtkSetClampMacro(Step, int, 0, 10000000);
  vtkGetMacro(Step, int);
  ///@}

  ///@{
  /// Acceleration, lengths / s^2. Default 0, 0, 0.
  void SetGravity(double x, double y, double z);
  void SetGravity(const double gravity[3]);
  vtkGetVector3Macro(Gravity, double);
  ///@}

  ///@{
  /// Mass per volume (of surfaces per area), above 0. Default 1.
  void SetDensity(double density);
  vtkGetMacro(Density, double);
  ///@}

  ///@{
  /**
   * How much the body resists bending: energy per volume (area) of a strain of one, above 0.
   * Default 1000. Waves run at sqrt(Stiffness / Density) lengths a second; under gravity g a part
   * of length l sags by about Density g l^2 / Stiffness.
   */
  void SetStiffness(double stiffness);
  vtkGetMacro(Stiffness, double);
  ///@}

  ///@{
  /// Drag of this times mass times velocity, 1 / s, 0 or more. Default 0.
  void SetDamping(double damping);
  vtkGetMacro(Damping, double);
  ///@}

  ///@{
  /// Most iterations of a step, 1 to 1e6. Default 50.
  void SetMaximumIterations(int iterations);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /// A step ends when an iteration lowers what it minimises by no more than this share. Default
  /// 1e-6; 0 runs all iterations.
  void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// As vtkReducedARAP's, of each step. Default on.
  void SetMixedPrecision(bool mixed);
  vtkGetMacro(MixedPrecision, bool);
  vtkBooleanMacro(MixedPrecision, bool);
  ///@}

  ///@{
  /// One step at each execution, see above. Default off.
  void SetInteractive(bool interactive);
  vtkGetMacro(Interactive, bool);
  vtkBooleanMacro(Interactive, bool);
  ///@}

  ///@{
  /**
   * Whether the output gets the point arrays `RotationCluster`, the number of the rotation that a
   * vertex follows, and `Rotation`, its axis times its angle in degrees, 0 to 180: see
   * vtkReducedARAP. Default off.
   */
  vtkSetMacro(RotationArrays, bool);
  vtkGetMacro(RotationArrays, bool);
  vtkBooleanMacro(RotationArrays, bool);
  ///@}

  /// The next execution begins at time 0.
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
  bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) override;
  bool FindsRotations() override { return true; }
  bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) override;
  bindpose::Status DeformNormals(const PoseInput& input, bindpose::ExecutionContext& context,
    const PosedPoints& posed, PosedPoints& normals) override;

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

  int Energy = 0;
  int NumberOfClusters = 0;
  int NumberOfExtraWeights = 0;
  int ExtraWeightsKind = 0;
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
  bool RotationArrays = false;
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
