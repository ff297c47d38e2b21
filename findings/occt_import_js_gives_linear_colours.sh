#!/usr/bin/env bash
# What:      A STEP file says COLOUR_RGB 0.5, 0.5, 0.5, the grey that CAD programs show as #808080. occt-import-js returns 0.214: its
#            numbers are of linear light, as OpenCASCADE keeps them since 7.5, where the file's are of sRGB. Times 255 that is #373737.
# Versions:  occt-import-js 0.0.23 (npm)
# Seen on:   30 November 2026, Debian 12, x86-64, Node.js 20.20.2
# Matters:   parts that are told apart by colour are too dark where the numbers go to CSS or to a .ply; the setRGB of three.js takes linear
#            numbers, its setStyle does not.
# Solidus:   tells bodies apart by names and shapes, and gives them its own colours.
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_modules occt-import-js=0.0.23

# A disc with a colour, in mm.
cat >"$modules/grey.step" <<'STEP'
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
#1 = APPLICATION_CONTEXT('');
#2 = PRODUCT_CONTEXT('',#1,'mechanical');
#3 = PRODUCT('disc','disc','',(#2));
#4 = PRODUCT_DEFINITION_FORMATION('','',#3);
#5 = PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');
#6 = PRODUCT_DEFINITION('design','',#4,#5);
#7 = PRODUCT_DEFINITION_SHAPE('','',#6);
#8 = SHAPE_DEFINITION_REPRESENTATION(#7,#9);
#9 = MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#20),#10);
#10 = ( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#11,#12,#13)) REPRESENTATION_CONTEXT('','') );
#11 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );
#12 = ( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) );
#13 = ( NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT() );
#20 = SHELL_BASED_SURFACE_MODEL('',(#21));
#21 = OPEN_SHELL('',(#22));
#22 = ADVANCED_FACE('',(#23),#30,.T.);
#23 = FACE_BOUND('',#24,.T.);
#24 = EDGE_LOOP('',(#25));
#25 = ORIENTED_EDGE('',*,*,#26,.T.);
#26 = EDGE_CURVE('',#27,#27,#28,.T.);
#27 = VERTEX_POINT('',#29);
#28 = CIRCLE('',#31,10.);
#29 = CARTESIAN_POINT('',(10.,0.,0.));
#30 = PLANE('',#31);
#31 = AXIS2_PLACEMENT_3D('',#32,#33,#34);
#32 = CARTESIAN_POINT('',(0.,0.,0.));
#33 = DIRECTION('',(0.,0.,1.));
#34 = DIRECTION('',(1.,0.,0.));
#40 = MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#41),#10);
#41 = STYLED_ITEM('color',(#42),#20);
#42 = PRESENTATION_STYLE_ASSIGNMENT((#43));
#43 = SURFACE_STYLE_USAGE(.BOTH.,#44);
#44 = SURFACE_SIDE_STYLE('',(#45));
#45 = SURFACE_STYLE_FILL_AREA(#46);
#46 = FILL_AREA_STYLE('',(#47));
#47 = FILL_AREA_STYLE_COLOUR('',#48);
#48 = COLOUR_RGB('',0.5,0.5,0.5);
ENDSEC;
END-ISO-10303-21;
STEP
said=$(in_node <<'SCRIPT'
import { readFileSync } from "node:fs";
import load from "occt-import-js";

const [mesh] = (await load()).ReadStepFile(readFileSync("grey.step"), null).meshes;
console.log(`0.5 is ${mesh.color.map((part) => part.toFixed(4)).join(", ")}`);
const curve = (part) => (part <= 0.0031308 ? 12.92 * part : 1.055 * part ** (1 / 2.4) - 0.055);
console.log(`by the curve of sRGB: ${mesh.color.map((part) => curve(part).toFixed(4)).join(", ")}`);
SCRIPT
)
expect "$said" <<END
0.5 is 0.2140, 0.2140, 0.2140
by the curve of sRGB: 0.5000, 0.5000, 0.5000
END
