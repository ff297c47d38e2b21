// A pillow block: a foot with two slots, a bearing bore of 40 mm, two ribs; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {-80,-22,0, 160,44,16};
Cylinder(2) = {0,-26,50, 0,52,0, 36};
Box(3) = {-30,-22,10, 60,44,40};
Box(4) = {-62,-5,10, 124,10,30};
BooleanUnion(5) = {Volume{1}; Delete;}{Volume{2,3,4}; Delete;};
Cylinder(6) = {0,-40,50, 0,80,0, 20};
Box(7) = {-70,-6,-5, 18,12,40}; Box(8) = {52,-6,-5, 18,12,40};
BooleanDifference(9) = {Volume{5}; Delete;}{Volume{6,7,8}; Delete;};
