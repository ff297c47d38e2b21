// A fan: a hub of 44 mm with a bore of 18 mm and six blades of 3 mm, for a die; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,40, 22};
n = 6;
For i In {0:n-1}
  Box(10+i) = {18,-1.5,2, 52,3,36};
  Rotate{{0,0,1},{0,0,20},2*Pi*i/n}{ Volume{10+i}; }
EndFor
v() = BooleanUnion{ Volume{1}; Delete; }{ Volume{10:10+n-1}; Delete; };
Cylinder(100) = {0,0,-5, 0,0,50, 9};
BooleanDifference{ Volume{v()}; Delete; }{ Volume{100}; Delete; }
