#ifndef vtkArapEnergy_h
#define vtkArapEnergy_h

/// Values of the property Energy of vtkReducedARAP, vtkFullARAP, vtkReducedDynamics and
/// vtkCrowdDeformation. Each value selects the sets of edges that share a rotation.
struct vtkArapEnergy
{
  enum EnergyType
  {
    AUTO = 0, ///< TETRAHEDRA on tets, SPOKES_AND_RIMS on surfaces
    SPOKES_AND_RIMS = 1, ///< the edges of the elements around a vertex
    TETRAHEDRA = 2, ///< the edges of a tet
    TRIANGLES = 3, ///< the edges of a triangle
    SPOKES = 4 ///< the edges that end at a vertex, without edges of negative cotangent weight
  };
};

#endif
