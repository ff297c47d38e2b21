// A grate of 160 x 120 mm: a frame of 10 mm, five bars along and three across, 8 mm thick: fronts meet in every bar; lengths in mm.
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 160,120,10};
n = 2;
For i In {0:3}
  For j In {0:2}
    Box(n) = {10+36*i,10+34.6667*j,-1, 28,26.6667,12};
    n += 1;
  EndFor
EndFor
BooleanDifference(100) = {Volume{1}; Delete;}{Volume{2:n-1}; Delete;};
