// A bar with two thick places and a riser: section, thickness one metre. Millimetres.
//
//        +----+
//        |    |  riser
//   +----+    +--+            +------+
//   |            +------------+      |
//   |            +------------+      |
//   +------------+            +------+
DefineConstant[ size = {3, Name "size"} ];
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 60, 40};
Rectangle(2) = {60, 14, 0, 80, 12};
Rectangle(3) = {140, 5, 0, 30, 30};
Rectangle(4) = {15, 40, 0, 30, 50};
BooleanUnion(10) = { Surface{1}; Delete; }{ Surface{2, 3, 4}; Delete; };
top() = Curve In BoundingBox{14, 89, -1, 46, 91, 1};
all() = Boundary{ Surface{:}; };
all() -= top();
Physical Surface("casting") = {Surface{:}};
Physical Curve("riser_top") = {top()};
Physical Curve("walls") = {all()};
Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = size;
