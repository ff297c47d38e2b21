// Two balls of 30 mm on a bar of 12 mm.
SetFactory("OpenCASCADE");
Sphere(1) = {0, -40, 0, 15};
Sphere(2) = {0, 40, 0, 15};
Cylinder(3) = {0, -40, 0, 0, 80, 0, 6};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; }
