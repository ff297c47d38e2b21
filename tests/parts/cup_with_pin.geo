// A cup of 50 mm with walls of 6 mm and a boss around a bore of 10 mm, whose pin is the die's; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,60, 25};
Cylinder(2) = {0,0,6, 0,0,60, 19};
Cylinder(3) = {0,0,0, 0,0,30, 12};
Cylinder(4) = {0,0,-1, 0,0,40, 5};
a() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; };
b() = BooleanUnion{ Volume{a()}; Delete; }{ Volume{3}; Delete; };
BooleanDifference{ Volume{b()}; Delete; }{ Volume{4}; Delete; }
