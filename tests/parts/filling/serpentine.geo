// A serpentine: a bar of 12 x 10 mm that turns five times, for fluidity, from a round well of 30 mm; lengths in mm.
SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,24, 15};
For i In {0:5}
  Box(10+i) = {0,30*i-6,0, 140,12,10};
EndFor
For i In {0:4}
  x = (i % 2 == 0) ? 128 : 0;
  Box(20+i) = {x,30*i-6,0, 12,42,10};
EndFor
BooleanUnion(40) = {Volume{1}; Delete;}{Volume{10:15,20:24}; Delete;};
