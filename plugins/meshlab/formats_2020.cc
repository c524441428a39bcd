/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the export formats in the shape that MeshLab up to 2020.09 asks for. */
#include "formats_2020.h"
#include "border.h"
#include <wrap/io_trimesh/io_mask.h>

QList<MeshIOInterface::Format> FairsurfFormats::exportFormats() const {
  QList<Format> formats;
  for (int i = 0; format_exporter(i) != nullptr; i++)
    formats << Format(QString("Fairsurf %1").arg(format_exporter(i)->name),
                      QString(format_exporter(i)->extension).toUpper());
  return formats;
}

void FairsurfFormats::GetExportMaskCapability(QString &, int &capability, int &defaultBits) const {
  capability = defaultBits = vcg::tri::io::Mask::IOM_BITPOLYGONAL;
}

void FairsurfFormats::initSaveParameter(const QString &format, MeshModel &, RichParameterList &list) {
  filter_param params[MAX_FORMAT_PARAMS];
  const fs_exporter *exporter = format_find(format.toUtf8().constData());
  if (exporter == nullptr) return;
  format_list_params(exporter, params);
  fairsurf::addParams(params, list);
}

bool FairsurfFormats::save(const QString &format, const QString &path, MeshModel &model, const int,
                           const RichParameterList &list, vcg::CallBackPos *callback, QWidget *) {
  std::string failure = fairsurf::save(format, path, model.cm, list, callback);
  errorMessage = QString::fromStdString(failure);
  return failure.empty();
}
