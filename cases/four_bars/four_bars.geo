// Four round bars of a tree, each in its shell, cut across. Lengths in millimetres.
DefineConstant[ bar = {15, Name "bar"} ];          // radius
DefineConstant[ shell = {8, Name "shell"} ];       // thickness
DefineConstant[ from_axis = {34, Name "from_axis"} ]; // centres of the bars, along x and along y
DefineConstant[ size = {2.8, Name "size"} ];

SetFactory("OpenCASCADE");
n = 0;
For i In {0:1}
  For j In {0:1}
    n += 1;
    x = (2 * i - 1) * from_axis;
    y = (2 * j - 1) * from_axis;
    Circle(10 * n + 1) = {x, y, 0, bar};
    Circle(10 * n + 2) = {x, y, 0, bar + shell};
    Curve Loop(10 * n + 1) = {10 * n + 1};
    Curve Loop(10 * n + 2) = {10 * n + 2};
    Plane Surface(10 * n + 1) = {10 * n + 1};
    Plane Surface(10 * n + 2) = {10 * n + 2, 10 * n + 1};
  EndFor
EndFor
Physical Surface("bars") = {11, 21, 31, 41};
Physical Surface("shells") = {12, 22, 32, 42};
Physical Curve("skin") = {12, 22, 32, 42};
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
