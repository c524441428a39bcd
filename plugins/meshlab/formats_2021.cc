/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the export formats in the shape that MeshLab from 2022.02 on asks for. */
#include "formats_2021.h"
#include <common/ml_document/mesh_document.h>
#include "border.h"
#include <wrap/io_trimesh/io_mask.h>

std::list<FileFormat> FairsurfFormats::exportFormats() const {
  std::list<FileFormat> formats;
  for (int i = 0; format_exporter(i) != nullptr; i++)
    formats.push_back(FileFormat(QString("Fairsurf %1").arg(format_exporter(i)->name),
                                 QString(format_exporter(i)->extension).toUpper()));
  return formats;
}

void FairsurfFormats::exportMaskCapability(const QString &, int &capability, int &defaultBits) const {
  capability = defaultBits = vcg::tri::io::Mask::IOM_BITPOLYGONAL;
}

RichParameterList FairsurfFormats::initSaveParameter(const QString &format, const MeshModel &) const {
  RichParameterList list;
  filter_param params[MAX_FORMAT_PARAMS];
  const fs_exporter *exporter = format_find(format.toUtf8().constData());
  if (exporter == nullptr) return list;
  format_list_params(exporter, params);
  fairsurf::addParams(params, list);
  return list;
}

void FairsurfFormats::save(const QString &format, const QString &path, MeshModel &model, const int,
                           const RichParameterList &list, vcg::CallBackPos *callback) {
  std::string failure = fairsurf::save(format, path, model.cm, list, callback);
  if (!failure.empty()) throw MLException(QString::fromStdString(failure));
}
