// Posers are compared with the filters: the results must have the same bits. The skinning methods
// are tested in tests/core/poser, because posers and filters share their code (SkinningBind).
#include "poser/make_poser.h"
#include "rigs.h"

#include "pose/transform_parts.h"

#include "vtkFullARAP.h"
#include "vtkReducedARAP.h"
#include "vtkSkinningDeformation.h"
#include "vtkVariationalSurface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

using namespace bindpose;
using test::beam;
using test::Rig;
using test::some_pose;

namespace
{
Points points_of(vtkDataSet* data)
{
  return to_points(data).view();
}

/// Return the filter's result for the rig in the given pose.
Points filter_points(vtkPoseAlgorithm* filter, const Rig& rig, const Pose& pose, vtkDataSet* mesh)
{
  vtkNew<vtkPolyData> handles;
  handles->DeepCopy(rig.handles);
  set_pose(handles, rig.cells, pose);
  filter->SetInputData(0, mesh);
  filter->SetInputData(1, handles);
  filter->Update();
  EXPECT_LE(filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED) << filter->GetStatusMessage();
  return points_of(filter->GetOutput());
}

Points poser_points(const Rig& rig, const Pose& pose, const PoseOptions& options)
{
  ExecutionContext context;
  const auto poser = make_poser(options.method, rig.source());
  Status status = poser->bind(context, options);
  EXPECT_TRUE(status.usable()) << status.message;
  Points posed;
  status = poser->solve(context, pose, options, 0, posed);
  EXPECT_TRUE(status.usable()) << status.message;
  return posed;
}

PoseOptions options_for(PoseMethod method)
{
  PoseOptions options;
  options.method = method;
  return options;
}
} // namespace

TEST(Poser, AnIgnoredStretchIsSaid)
{
  const Rig rig = beam();
  const auto warnings = [&](PoseMethod method, const Pose& pose)
  {
    ExecutionContext context;
    const auto poser = make_poser(method, rig.source());
    const PoseOptions options = options_for(method);
    Status status = poser->bind(context, options);
    EXPECT_TRUE(status.usable()) << status.message;
    Points posed;
    status = poser->solve(context, pose, options, 0, posed);
    EXPECT_TRUE(status.usable()) << status.message;
    return std::count_if(status.warnings.begin(), status.warnings.end(),
      [](const std::string& text)
      { return text.find("stretches or twists bones") != std::string::npos; });
  };
  Pose rest(rig.list.size());
  Pose twisted = rest;
  twisted[2].twist[1] = 30.0;
  Pose stretched = rest;
  stretched[3].stretch = 1.5;
  Pose rounded = rest;
  rounded[3].stretch = 1.0 + 1e-9;
  for (int k = 0; k < pose_method_count; ++k)
  {
    const auto method = static_cast<PoseMethod>(k);
    const int expected = method == PoseMethod::stretchable_bones ? 0 : 1;
    EXPECT_EQ(warnings(method, twisted), expected) << to_string(method);
    EXPECT_EQ(warnings(method, stretched), expected) << to_string(method);
    EXPECT_EQ(warnings(method, rest), 0) << to_string(method);
    EXPECT_EQ(warnings(method, rounded), 0) << to_string(method);
  }
  // As-rigid-as-possible methods use the stretch to compute the positions of both ends of a bone.
  stretched[3].mode = HandleMode::ends;
  EXPECT_EQ(warnings(PoseMethod::full_arap, stretched), 0);
  EXPECT_EQ(warnings(PoseMethod::linear_blend, stretched), 1);
}

TEST(Poser, EverySkinningMethodGivesWhatTheFilterGives)
{
  const Rig rig = beam();
  const Pose pose = some_pose(rig.list);
  const std::pair<PoseMethod, int> methods[] = { { PoseMethod::linear_blend,
                                                   vtkSkinningDeformation::LINEAR_BLEND },
    { PoseMethod::dual_quaternion, vtkSkinningDeformation::DUAL_QUATERNION },
    { PoseMethod::stretchable_bones, vtkSkinningDeformation::STRETCHABLE_BONES },
    { PoseMethod::rotation_centers, vtkSkinningDeformation::CENTERS_OF_ROTATION } };
  for (const auto& [method, of_filter] : methods)
  {
    for (const int edges : { 0, 1, 2 })
    {
      for (const bool single : { false, true })
      {
        vtkNew<vtkSkinningDeformation> filter;
        filter->SetMethod(of_filter);
        filter->SetPseudoEdges(edges);
        filter->SetSinglePrecision(single);
        PoseOptions options = options_for(method);
        options.pseudo_edges = static_cast<PseudoEdgeChoice>(edges);
        options.single_precision = single;
        EXPECT_EQ(poser_points(rig, pose, options), filter_points(filter, rig, pose, rig.surface))
          << to_string(method) << " edges " << edges << " single " << single;
      }
    }
  }
}

TEST(Poser, GivenEndpointWeightsAreUsed)
{
  const Rig rig = beam();
  Weights endpoints = Weights::Constant(rig.surface->GetNumberOfPoints(), 4, 0.25);
  const Points without =
    poser_points(rig, some_pose(rig.list), options_for(PoseMethod::stretchable_bones));
  rig.surface->GetPointData()->AddArray(to_weights_array("EndpointWeights", endpoints, rig.list));
  vtkNew<vtkSkinningDeformation> filter;
  filter->SetMethod(vtkSkinningDeformation::STRETCHABLE_BONES);
  const Points posed =
    poser_points(rig, some_pose(rig.list), options_for(PoseMethod::stretchable_bones));
  EXPECT_EQ(posed, filter_points(filter, rig, some_pose(rig.list), rig.surface));
  EXPECT_NE(posed, without);
}

TEST(Poser, ReducedArapGivesWhatTheFilterGives)
{
  const Rig rig = beam();
  Pose pose = some_pose(rig.list);
  pose[1].mode = HandleMode::free;
  pose[2].mode = HandleMode::position;
  for (const Index extra : { 0, 7 })
  {
    vtkNew<vtkReducedARAP> filter;
    filter->SetNumberOfExtraWeights(static_cast<int>(extra));
    PoseOptions options = options_for(PoseMethod::reduced_arap);
    options.extra_weights = extra;
    EXPECT_EQ(poser_points(rig, pose, options), filter_points(filter, rig, pose, rig.surface));
    // The points of the surface are the first points of the tets, with the same positions.
    vtkNew<vtkReducedARAP> tet_filter;
    tet_filter->SetNumberOfExtraWeights(static_cast<int>(extra));
    options.use_tet_energy = true;
    const Points all = filter_points(tet_filter, rig, pose, rig.tets);
    const Points surface = poser_points(rig, pose, options);
    EXPECT_LT((surface - all.topRows(surface.rows())).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Poser, RotationsAreTheFilters)
{
  const Rig rig = beam();
  Pose pose = some_pose(rig.list);
  pose[1].mode = HandleMode::free;
  for (const bool use_tet_energy : { false, true })
  {
    vtkNew<vtkReducedARAP> filter;
    filter->RotationArraysOn();
    const Points all = filter_points(
      filter, rig, pose, use_tet_energy ? static_cast<vtkDataSet*>(rig.tets) : rig.surface.Get());
    vtkPointData* arrays = filter->GetOutput()->GetPointData();
    PoseOptions options = options_for(PoseMethod::reduced_arap);
    options.use_tet_energy = use_tet_energy;
    ExecutionContext context;
    const auto poser = make_poser(options.method, rig.source());
    EXPECT_EQ(poser->rotations(), nullptr); // nothing has been bound
    ASSERT_TRUE(poser->bind(context, options).usable());
    Points posed;
    ASSERT_TRUE(poser->solve(context, pose, options, 0, posed).usable());
    const PoseRotations* found = poser->rotations();
    ASSERT_NE(found, nullptr);
    ASSERT_EQ(static_cast<Index>(found->cluster_of_point->size()), posed.rows());
    for (Index v = 0; v < posed.rows(); ++v)
    {
      const Index cluster = (*found->cluster_of_point)[static_cast<std::size_t>(v)];
      // The surface's points are the first points of the tets.
      EXPECT_EQ(
        static_cast<double>(cluster), arrays->GetArray("RotationCluster")->GetComponent(v, 0));
      EXPECT_EQ(rotation_vector(found->rotations[static_cast<std::size_t>(cluster)]),
        Vec3(arrays->GetArray("Rotation")->GetTuple3(v)));
    }
    const auto clusters = found->cluster_of_point;
    ASSERT_TRUE(poser->solve(context, Pose(4), options, 0, posed).usable());
    EXPECT_EQ(poser->rotations()->cluster_of_point, clusters); // a pose keeps the clusters
  }
  EXPECT_EQ(make_poser(PoseMethod::linear_blend, rig.source())->rotations(), nullptr);
}

TEST(Poser, FullArapGivesWhatTheFilterGives)
{
  const Rig rig = beam();
  const Pose pose = some_pose(rig.list, 0.3);
  vtkNew<vtkFullARAP> filter;
  EXPECT_EQ(poser_points(rig, pose, options_for(PoseMethod::full_arap)),
    filter_points(filter, rig, pose, rig.surface));
  vtkNew<vtkFullARAP> tet_filter;
  PoseOptions options = options_for(PoseMethod::full_arap);
  options.use_tet_energy = true;
  const Points all = filter_points(tet_filter, rig, pose, rig.tets);
  const Points surface = poser_points(rig, pose, options);
  EXPECT_EQ(surface, all.topRows(surface.rows()));
  // Each tet has a rotation; the points have no rotations.
  ExecutionContext context;
  const auto poser = make_poser(options.method, rig.source());
  Points posed;
  ASSERT_TRUE(poser->bind(context, options).usable());
  ASSERT_TRUE(poser->solve(context, pose, options, 0, posed).usable());
  const PoseRotations* rotations = poser->rotations();
  ASSERT_NE(rotations, nullptr);
  EXPECT_EQ(static_cast<Index>(rotations->rotations.size()), rig.tets->GetNumberOfCells());
  EXPECT_TRUE(rotations->cluster_of_point->empty());
}

TEST(Poser, ASolveInSlicesIsTheFilterRunInSlices)
{
  const Rig rig = beam();
  const Pose pose = some_pose(rig.list, 0.3);
  ExecutionContext context;
  const PoseOptions options = options_for(PoseMethod::full_arap);
  const auto poser = make_poser(options.method, rig.source());
  ASSERT_TRUE(poser->bind(context, options).usable());
  vtkNew<vtkPolyData> handles;
  handles->DeepCopy(rig.handles);
  set_pose(handles, rig.cells, pose);
  vtkNew<vtkFullARAP> filter;
  filter->SetInputData(0, rig.surface);
  filter->SetInputData(1, handles);
  for (const int slice : { 2, 4, 8 })
  {
    Points posed;
    ASSERT_TRUE(poser->solve(context, pose, options, slice, posed).usable());
    filter->SetMaximumIterations(slice);
    filter->Update();
    EXPECT_EQ(posed, points_of(filter->GetOutput()));
  }
  EXPECT_EQ(filter->GetNumberOfBinds(), poser->binds());
}

TEST(Poser, VariationalSurfacesGiveWhatTheFilterGives)
{
  const Rig rig = beam();
  const Pose pose = some_pose(rig.list, 0.3);
  for (const int order : { 1, 2 })
  {
    vtkNew<vtkVariationalSurface> filter;
    filter->SetOrder(order);
    PoseOptions options = options_for(PoseMethod::variational);
    options.order = order;
    EXPECT_EQ(poser_points(rig, pose, options), filter_points(filter, rig, pose, rig.surface));
  }
}

TEST(Poser, DragsDoNotBindAgain)
{
  const Rig rig = beam();
  ExecutionContext context;
  for (int method = 0; method < pose_method_count; ++method)
  {
    PoseOptions options = options_for(static_cast<PoseMethod>(method));
    const auto poser = make_poser(options.method, rig.source());
    ASSERT_TRUE(poser->bind(context, options).usable());
    Points posed;
    for (int drag = 0; drag < 5; ++drag)
    {
      ASSERT_TRUE(poser->bind(context, options).usable());
      Pose pose = some_pose(rig.list, 0.1 * drag);
      pose[2].mode = static_cast<HandleMode>(drag % 3);
      ASSERT_TRUE(poser->solve(context, pose, options, 5, posed).usable()) << method;
      // Options that apply at pose time do not require a bind.
      options.iterations += 1;
      options.budget_microseconds += 1.0;
    }
    EXPECT_EQ(poser->binds(), 1) << to_string(options.method);
  }
}

TEST(Poser, SkinningMethodsShareTheirBind)
{
  const Rig rig = beam();
  ExecutionContext context;
  PoseOptions options;
  const auto poser = make_poser(options.method, rig.source());
  ASSERT_TRUE(poser->bind(context, options).usable());
  for (const PoseMethod method : { PoseMethod::dual_quaternion, PoseMethod::stretchable_bones })
  {
    options.method = method;
    EXPECT_TRUE(same_poser(PoseMethod::linear_blend, method));
    EXPECT_TRUE(poser->is_bound(options));
  }
  options.method = PoseMethod::rotation_centers;
  EXPECT_FALSE(poser->is_bound(options)); // the centers of rotation are not computed
  ASSERT_TRUE(poser->bind(context, options).usable());
  EXPECT_EQ(poser->binds(), 2);
  options.method = PoseMethod::linear_blend;
  EXPECT_TRUE(poser->is_bound(options));
}

TEST(Poser, RigidMethodsFindRotationsOfHandlesThatOnlyMove)
{
  const Rig rig = beam();
  Pose automatic(rig.list.size());
  automatic[1].transform.col(3) = Vec3(0.2, 0.3, -0.1);
  Pose moved = automatic;
  Pose full = automatic;
  for (std::size_t k = 0; k < rig.list.size(); ++k)
  {
    const bool point = rig.list[k].kind == HandleKind::point;
    moved[k].mode = point || k == 1 ? HandleMode::position : HandleMode::full;
    full[k].mode = HandleMode::full;
  }
  for (const PoseMethod method : { PoseMethod::reduced_arap, PoseMethod::full_arap })
  {
    const PoseOptions options = options_for(method);
    EXPECT_EQ(poser_points(rig, automatic, options), poser_points(rig, moved, options));
    EXPECT_NE(poser_points(rig, automatic, options), poser_points(rig, full, options));
  }
  const PoseOptions blend = options_for(PoseMethod::linear_blend);
  EXPECT_EQ(poser_points(rig, automatic, blend), poser_points(rig, full, blend));
}

TEST(Poser, WhatCannotBePosedIsSaid)
{
  Rig rig = beam();
  ExecutionContext context;
  Points posed;
  PoseOptions options = options_for(PoseMethod::reduced_arap);
  auto poser = make_poser(options.method, rig.source());
  EXPECT_THAT(
    poser->solve(context, Pose(4), options, 0, posed).message, testing::HasSubstr("bound"));
  options.use_tet_energy = true;
  rig.tets = nullptr;
  poser = make_poser(options.method, rig.source());
  EXPECT_THAT(poser->bind(context, options).message, testing::HasSubstr("no tets"));
  rig.surface->GetPointData()->RemoveArray("Weights");
  options = options_for(PoseMethod::linear_blend);
  poser = make_poser(options.method, rig.source());
  EXPECT_THAT(poser->bind(context, options).message, testing::HasSubstr("bind first"));
  options = options_for(PoseMethod::full_arap); // this method needs no weights
  poser = make_poser(options.method, rig.source());
  EXPECT_TRUE(poser->bind(context, options).usable());
  EXPECT_THAT(
    poser->solve(context, Pose(3), options, 0, posed).message, testing::HasSubstr("handles"));

  // Without bones, stretchable-bone skinning equals linear blend skinning, and a warning is issued.
  Rig points = beam();
  for (Handle& handle : points.list)
  {
    handle.kind = HandleKind::point;
    handle.tail = handle.head;
  }
  points.handles = to_polydata(points.list);
  options = options_for(PoseMethod::stretchable_bones);
  options.endpoints = EndpointMethod::bounded;
  poser = make_poser(options.method, points.source());
  ASSERT_TRUE(poser->bind(context, options).usable());
  const Status status = poser->solve(context, Pose(4), options, 0, posed);
  ASSERT_EQ(status.warnings.size(), 1U);
  EXPECT_THAT(status.warnings[0], testing::HasSubstr("no handle is a bone"));
}

TEST(Poser, ABindIsCanceled)
{
  const Rig rig = beam();
  ExecutionContext context;
  context.request_cancel();
  for (const PoseMethod method : { PoseMethod::rotation_centers, PoseMethod::reduced_arap })
  {
    PoseOptions options = options_for(method);
    const auto poser = make_poser(method, rig.source());
    EXPECT_EQ(poser->bind(context, options).code, StatusCode::canceled);
    EXPECT_FALSE(poser->is_bound(options));
    ExecutionContext again;
    EXPECT_TRUE(poser->bind(again, options).usable());
  }
}
