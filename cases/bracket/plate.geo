// A stepped plate (40, 20 and 10 mm thick) with a riser on its thick end and a chill of iron before its thin
// one, in a block of sand; lengths in mm.
DefineConstant[ size = {7, Name "size"} ];            // of the elements in the part
DefineConstant[ sand_size = {13, Name "sand_size"} ];  // at the outside of the sand
SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 60,60,40};
Box(2) = {60,0,0, 60,60,20};
Box(3) = {120,0,0, 60,60,10};
Cylinder(4) = {30,30,40, 0,0,50, 22};
BooleanUnion(5) = {Volume{1}; Delete;}{Volume{2,3,4}; Delete;};
Box(20) = {181,0,-10, 20,60,30};
Box(10) = {-40,-40,-40, 290,140,130};
v() = Translate{0,0,0}{Duplicata{Volume{5};}};
w() = Translate{0,0,0}{Duplicata{Volume{20};}};
BooleanDifference(100) = {Volume{10}; Delete;}{Volume{v(), w()}; Delete;};
Physical Volume("part") = {5};
Physical Volume("chill") = {20};
Physical Volume("mould") = {100};
ps() = Abs(Boundary{Volume{5};});
cs() = Abs(Boundary{Volume{20};});
ms() = Abs(Boundary{Volume{100};});
tops() = Surface In BoundingBox{-1,-1,89.9, 181,61,90.1};
cav() = Surface In BoundingBox{-1,-1,-1, 180.5,61,90.5};
chc() = Surface In BoundingBox{180.5,-1,-11, 202,61,21};
part_surface() = {};
For i In {0:#ps()-1}
  isTop = 0;
  For j In {0:#tops()-1}
    If (ps(i)==tops(j)) isTop = 1; EndIf
  EndFor
  If (!isTop) part_surface() += ps(i); EndIf
EndFor
mould_surface() = {}; outside() = {}; mould_chill() = {};
For i In {0:#ms()-1}
  isC = 0;
  For j In {0:#cav()-1}
    If (ms(i)==cav(j)) isC = 1; EndIf
  EndFor
  For j In {0:#chc()-1}
    If (ms(i)==chc(j)) isC = 2; EndIf
  EndFor
  If (isC==1) mould_surface() += ms(i); EndIf
  If (isC==2) mould_chill() += ms(i); EndIf
  If (isC==0) outside() += ms(i); EndIf
EndFor
Physical Surface("part_surface") = part_surface();
Physical Surface("part_top") = tops();
Physical Surface("chill_surface") = cs();
Physical Surface("mould_surface") = mould_surface();
Physical Surface("mould_chill") = mould_chill();
Physical Surface("mould_outside") = outside();
Mesh.MeshSizeExtendFromBoundary = 1;
MeshSize{ PointsOf{Volume{100};} } = sand_size;
MeshSize{ PointsOf{Volume{20};} } = 10;
MeshSize{ PointsOf{Volume{5};} } = size;
MeshSize{ PointsOf{Surface{mould_surface()};} } = size;
