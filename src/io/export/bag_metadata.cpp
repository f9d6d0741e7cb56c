// bag_metadata.cpp -- elements of ISO 19139 that the BAG format asks for and GDAL reads.
//
// Format Specification Document of the Bathymetric Attributed Grid Object, version 1.6 (2018), section 2.

#include "io/export/bag_metadata.h"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

namespace insonify {
namespace {

constexpr const char* kCodeLists = "http://www.isotc211.org/2005/resources/Codelist/gmxCodelists.xml#";

pugi::xml_node add(pugi::xml_node to, const char* name) {
  return to.append_child(name);
}

void add_value(pugi::xml_node to, const char* name, const char* type, const std::string& value) {
  add(add(to, name), type).text().set(value.c_str());
}

void add_text(pugi::xml_node to, const char* name, const std::string& value) {
  add_value(to, name, "gco:CharacterString", value);
}

// A word of a code list.
void add_code(pugi::xml_node to, const char* name, const std::string& list, const char* value) {
  const std::size_t prefix = list.find(':') + 1;
  pugi::xml_node code = add(add(to, name), list.c_str());
  code.append_attribute("codeList") = (kCodeLists + list.substr(prefix)).c_str();
  code.append_attribute("codeListValue") = value;
  code.text().set(value);
}

void add_party(pugi::xml_node to, const char* name) {
  pugi::xml_node party = add(add(to, name), "gmd:CI_ResponsibleParty");
  add_text(party, "gmd:organisationName", "insonify");
  add_code(party, "gmd:role", "gmd:CI_RoleCode", "processor");
}

void add_axis(pugi::xml_node to, const char* name, int size, const char* unit, double resolution) {
  pugi::xml_node axis = add(add(to, "gmd:axisDimensionProperties"), "gmd:MD_Dimension");
  add_code(axis, "gmd:dimensionName", "gmd:MD_DimensionNameTypeCode", name);
  add_value(axis, "gmd:dimensionSize", "gco:Integer", std::to_string(size));
  pugi::xml_node measure = add(add(axis, "gmd:resolution"), "gco:Measure");
  measure.append_attribute("uom") = unit;
  measure.text().set(fmt::format("{:.12g}", resolution).c_str());
}

// Rows, columns and the middles of the south-western and the north-eastern cell.
void add_representation(pugi::xml_node to, const BagFacts& facts, const RasterPlacement& place) {
  const char* const unit = facts.origin ? "degree" : "m";
  pugi::xml_node grid = add(add(to, "gmd:spatialRepresentationInfo"), "gmd:MD_Georectified");
  add_value(grid, "gmd:numberOfDimensions", "gco:Integer", "2");
  add_axis(grid, "row", facts.raster.rows, unit, place.cell_y);
  add_axis(grid, "column", facts.raster.columns, unit, place.cell_x);
  add_code(grid, "gmd:cellGeometry", "gmd:MD_CellGeometryCode", "point");
  add_value(grid, "gmd:transformationParameterAvailability", "gco:Boolean", "1");
  add_value(grid, "gmd:checkPointAvailability", "gco:Boolean", "0");
  pugi::xml_node point = add(add(grid, "gmd:cornerPoints"), "gml:Point");
  point.append_attribute("gml:id") = "id1";
  pugi::xml_node corners = add(point, "gml:coordinates");
  corners.append_attribute("decimal") = ".";
  corners.append_attribute("cs") = ",";
  corners.append_attribute("ts") = " ";
  corners.text().set(fmt::format("{:.12g},{:.12g} {:.12g},{:.12g}", place.west + 0.5 * place.cell_x,
                                 place.north - (facts.raster.rows - 0.5) * place.cell_y,
                                 place.west + (facts.raster.columns - 0.5) * place.cell_x,
                                 place.north - 0.5 * place.cell_y)
                         .c_str());
  add_value(grid, "gmd:pointInPixel", "gmd:MD_PixelOrientationCode", "center");
}

void add_reference(pugi::xml_node to, const std::string& well_known_text) {
  pugi::xml_node identifier =
      add(add(add(add(to, "gmd:referenceSystemInfo"), "gmd:MD_ReferenceSystem"), "gmd:referenceSystemIdentifier"),
          "gmd:RS_Identifier");
  add_text(identifier, "gmd:code", well_known_text);
  add_text(identifier, "gmd:codeSpace", "WKT");
}

void add_extent(pugi::xml_node to, const BagFacts& facts, const RasterPlacement& place) {
  pugi::xml_node box =
      add(add(add(add(to, "gmd:extent"), "gmd:EX_Extent"), "gmd:geographicElement"), "gmd:EX_GeographicBoundingBox");
  const auto degrees = [](double value) { return fmt::format("{:.9f}", value); };
  add_value(box, "gmd:westBoundLongitude", "gco:Decimal", degrees(place.west));
  add_value(box, "gmd:eastBoundLongitude", "gco:Decimal", degrees(place.west + facts.raster.columns * place.cell_x));
  add_value(box, "gmd:southBoundLatitude", "gco:Decimal", degrees(place.north - facts.raster.rows * place.cell_y));
  add_value(box, "gmd:northBoundLatitude", "gco:Decimal", degrees(place.north));
}

void add_identification(pugi::xml_node to, const BagFacts& facts, const RasterPlacement& place) {
  pugi::xml_node about = add(add(to, "gmd:identificationInfo"), "bag:BAG_DataIdentification");
  pugi::xml_node citation = add(add(about, "gmd:citation"), "gmd:CI_Citation");
  add_text(citation, "gmd:title", facts.title);
  pugi::xml_node date = add(add(citation, "gmd:date"), "gmd:CI_Date");
  add_value(date, "gmd:date", "gco:Date", facts.date);
  add_code(date, "gmd:dateType", "gmd:CI_DateTypeCode", "creation");
  add_party(citation, "gmd:citedResponsibleParty");
  add_text(about, "gmd:abstract", facts.abstract);
  add_code(about, "gmd:spatialRepresentationType", "gmd:MD_SpatialRepresentationTypeCode", "grid");
  add_code(about, "gmd:language", "gmd:LanguageCode", "eng");
  add_value(about, "gmd:topicCategory", "gmd:MD_TopicCategoryCode", "elevation");
  if (facts.origin) {
    add_extent(about, facts, place);
  }
  add_code(about, "bag:verticalUncertaintyType", "bag:BAG_VertUncertCode", "unknown");
}

void add_quality(pugi::xml_node to, const BagFacts& facts) {
  pugi::xml_node quality = add(add(to, "gmd:dataQualityInfo"), "gmd:DQ_DataQuality");
  add_code(add(add(quality, "gmd:scope"), "gmd:DQ_Scope"), "gmd:level", "gmd:MD_ScopeCode", "dataset");
  pugi::xml_node step =
      add(add(add(add(quality, "gmd:lineage"), "gmd:LI_Lineage"), "gmd:processStep"), "bag:BAG_ProcessStep");
  add_text(step, "gmd:description", facts.process);
  add_value(step, "gmd:dateTime", "gco:DateTime", facts.date + "T00:00:00");
  add_text(step, "bag:trackingId", "0");
}

void add_constraints(pugi::xml_node to) {
  pugi::xml_node legal = add(add(to, "gmd:metadataConstraints"), "gmd:MD_LegalConstraints");
  add_code(legal, "gmd:useConstraints", "gmd:MD_RestrictionCode", "otherRestrictions");
  add_text(legal, "gmd:otherConstraints", "simulated, not for navigation");
  pugi::xml_node security = add(add(to, "gmd:metadataConstraints"), "gmd:MD_SecurityConstraints");
  add_code(security, "gmd:classification", "gmd:MD_ClassificationCode", "unclassified");
  add_text(security, "gmd:userNote", "none");
}

}  // namespace

std::string bag_metadata(const BagFacts& facts) {
  const RasterPlacement place = placement_of(facts.raster, facts.origin);
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("gmi:MI_Metadata");
  const std::pair<const char*, const char*> spaces[] = {{"xmlns:gmi", "http://www.isotc211.org/2005/gmi"},
                                                        {"xmlns:gmd", "http://www.isotc211.org/2005/gmd"},
                                                        {"xmlns:gml", "http://www.opengis.net/gml/3.2"},
                                                        {"xmlns:gco", "http://www.isotc211.org/2005/gco"},
                                                        {"xmlns:bag", "http://www.opennavsurf.org/schema/bag"}};
  for (const auto& [name, space] : spaces) {
    root.append_attribute(name) = space;
  }
  add_code(root, "gmd:language", "gmd:LanguageCode", "eng");
  add_party(root, "gmd:contact");
  add_value(root, "gmd:dateStamp", "gco:Date", facts.date);
  add_text(root, "gmd:metadataStandardName", "ISO 19139");
  add_text(root, "gmd:metadataStandardVersion", "1.1.0");
  add_representation(root, facts, place);
  add_reference(root, facts.origin ? "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
                                     "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433],AUTHORITY[\"EPSG\","
                                     "\"4326\"]]"
                                   : "LOCAL_CS[\"world of the simulation\",UNIT[\"metre\",1],AXIS[\"East\",EAST],"
                                     "AXIS[\"North\",NORTH]]");
  add_reference(root, fmt::format("VERT_CS[\"height\",VERT_DATUM[\"z = {:.6g} m in the world of the simulation\",2000],"
                                  "UNIT[\"metre\",1],AXIS[\"Height\",UP]]",
                                  facts.datum));
  add_identification(root, facts, place);
  add_quality(root, facts);
  add_constraints(root);
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace insonify
