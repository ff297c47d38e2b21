// An L of two plates of 15 mm with two bores and a rib; lengths in mm. Makes bracket.step:
//   (cat bracket.geo; echo 'Save "bracket.step";') > save.geo && gmsh -0 save.geo
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 100,60,15};
Box(2) = {0,0,0, 15,60,80};
BooleanUnion(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
Cylinder(4) = {70,30,-1, 0,0,30, 10};
Cylinder(5) = {-1,30,55, 30,0,0, 8};
BooleanDifference(6) = {Volume{3}; Delete;}{Volume{4,5}; Delete;};
// The rib, a prism.
Point(101) = {15,27,15}; Point(102) = {45,27,15}; Point(103) = {15,27,40};
Line(201) = {101,102}; Line(202)={102,103}; Line(203)={103,101};
Curve Loop(301)={201,202,203}; Plane Surface(301)={301};
e() = Extrude{0,6,0}{Surface{301};};
BooleanUnion(77) = {Volume{6}; Delete;}{Volume{e(1)}; Delete;};
