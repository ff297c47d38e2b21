// Half of a cover of 100 mm x 80 mm x 6 mm with a boss, in a die of two halves. Lengths in mm; x = 0 is the plane of
// symmetry, z = 0 the parting plane. The channels are no geometry: case.toml has them as lines.
SetFactory("OpenCASCADE");
DefineConstant[ size = {5, Name "size"} ];
Box(1) = {0, 30, 0, 50, 80, 6};
Box(2) = {0, 57, 0, 12, 26, 26};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {0, 0, -50, 80, 140, 50};
Box(5) = {0, 0, 0, 80, 140, 60};
BooleanDifference(6) = { Volume{5}; Delete; }{ Volume{3}; };
BooleanFragments{ Volume{3}; Delete; }{ Volume{4, 6}; Delete; }
Physical Volume("casting") = {3};
Physical Volume("ejector_half") = {4};
Physical Volume("cover_half") = {6};
Field[1] = Box;
Field[1].VIn = size; Field[1].VOut = 2.6 * size; Field[1].Thickness = 40;
Field[1].XMin = -1; Field[1].XMax = 50; Field[1].YMin = 30; Field[1].YMax = 110; Field[1].ZMin = -1; Field[1].ZMax = 27;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
