// A plate with a window, which the metal passes on both sides; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 120, 8, 80};
Box(2) = {45, -1, 30, 30, 10, 30};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("plate") = {3};
