/* SPDX-License-Identifier: MIT */
/* Single role: what stands around the geometry: the head of the file, the product, the units, and the representation that
   ties the solids and shells to the product [ISO 10303-214]. */
#include "step.h"

fs_step_frame fs_step_write_head(fs_step_file *step, const fs_model *model, fs_step_unit unit, double accuracy) {
  fs_writer *writer = &step->writer;
  fs_step_frame frame;
  int64_t application, product, definition, context, length, angle, solid_angle, uncertainty;

  fs_writer_text(writer, "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((");
  fs_step_string(step, model->made_with != NULL ? model->made_with : "fairsurf");
  fs_writer_text(writer, "),'2;1');\nFILE_NAME(");
  fs_step_string(step, model->name);
  /* one time for all: equal models give equal files */
  fs_writer_text(writer, ",'1970-01-01T00:00:00',(''),(''),'fairsurf','fairsurf','');\n"
                         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n");

  application = fs_step_entity(step, "APPLICATION_CONTEXT('automotive design')", NULL);
  fs_step_entity(step, "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,%)",
                 &application);
  context = fs_step_entity(step, "PRODUCT_CONTEXT('',%,'mechanical')", &application);
  product = fs_step_begin(step, "PRODUCT(");
  fs_step_string(step, model->name);
  fs_writer_text(writer, ",");
  fs_step_string(step, model->name);
  fs_writer_text(writer, ",'',(");
  fs_step_reference(step, context);
  fs_writer_text(writer, ")");
  fs_step_end(step);
  fs_step_entity(step, "PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(%))", &product);
  definition = fs_step_entity(step, "PRODUCT_DEFINITION_FORMATION('','',%)", &product);
  context = fs_step_entity(step, "PRODUCT_DEFINITION_CONTEXT('part definition',%,'design')", &application);
  definition = fs_step_entity(step, "PRODUCT_DEFINITION('design','',%,%)", (const int64_t[]){definition, context});
  frame.shape = fs_step_entity(step, "PRODUCT_DEFINITION_SHAPE('','',%)", &definition);

  length = fs_step_entity(step,
                          unit == FS_STEP_M    ? "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))"
                          : unit == FS_STEP_CM ? "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.))"
                                               : "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))",
                          NULL);
  if (unit == FS_STEP_IN) {
    int64_t of[2] = {fs_step_entity(step, "DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)", NULL), 0};
    of[1] = fs_step_entity(step, "LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),%)", &length);
    length = fs_step_entity(step, "(CONVERSION_BASED_UNIT('INCH',%)LENGTH_UNIT()NAMED_UNIT(%))",
                            (const int64_t[]){of[1], of[0]});
  }
  angle = fs_step_entity(step, "(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))", NULL);
  solid_angle = fs_step_entity(step, "(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())", NULL);
  uncertainty = fs_step_begin(step, "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(");
  fs_step_real(step, accuracy);
  fs_writer_text(writer, "),");
  fs_step_reference(step, length);
  fs_writer_text(writer, ",'distance_accuracy_value','')");
  fs_writer_text(writer, ";\n");
  frame.context = fs_step_entity(step,
                                 "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((%))"
                                 "GLOBAL_UNIT_ASSIGNED_CONTEXT((%,%,%))REPRESENTATION_CONTEXT('',''))",
                                 (const int64_t[]){uncertainty, length, angle, solid_angle});
  return frame;
}

static int64_t write_origin(fs_step_file *step) {
  int64_t axis[3] = {fs_step_entity(step, "CARTESIAN_POINT('',(0.,0.,0.))", NULL),
                     fs_step_entity(step, "DIRECTION('',(0.,0.,1.))", NULL),
                     fs_step_entity(step, "DIRECTION('',(1.,0.,0.))", NULL)};
  return fs_step_entity(step, "AXIS2_PLACEMENT_3D('',%,%,%)", axis);
}

static int64_t write_representation(fs_step_file *step, const char *type, int64_t origin, int64_t n,
                                    const int64_t *item, int64_t context) {
  int64_t representation = fs_step_begin(step, type);
  fs_writer_text(&step->writer, "('',(");
  fs_step_reference(step, origin);
  for (int64_t k = 0; k < n; k++) {
    fs_writer_text(&step->writer, ",");
    fs_step_reference(step, item[k]);
  }
  fs_writer_text(&step->writer, "),");
  fs_step_reference(step, context);
  fs_step_end(step);
  return representation;
}

/* Solids and shells are different kinds of representations; where there are both, a third one relates them. */
void fs_step_write_foot(fs_step_file *step, const fs_step_frame *frame, int64_t n_solids, const int64_t *solid,
                        int64_t n_shells, const int64_t *shell) {
  int64_t origin = write_origin(step), of[3] = {frame->shape};
  if (n_solids > 0)
    of[1] = write_representation(step, "ADVANCED_BREP_SHAPE_REPRESENTATION", origin, n_solids, solid, frame->context);
  if (n_shells > 0)
    of[2] =
        write_representation(step, "MANIFOLD_SURFACE_SHAPE_REPRESENTATION", origin, n_shells, shell, frame->context);
  if (n_solids > 0 && n_shells > 0) {
    int64_t both[2] = {write_representation(step, "SHAPE_REPRESENTATION", origin, 0, NULL, frame->context), 0};
    for (int32_t k = 1; k < 3; k++) {
      both[1] = of[k];
      fs_step_entity(step, "SHAPE_REPRESENTATION_RELATIONSHIP('','',%,%)", both);
    }
    of[1] = both[0];
  } else if (n_shells > 0) {
    of[1] = of[2];
  }
  fs_step_entity(step, "SHAPE_DEFINITION_REPRESENTATION(%,%)", of);
  fs_writer_text(&step->writer, "ENDSEC;\nEND-ISO-10303-21;\n");
}
