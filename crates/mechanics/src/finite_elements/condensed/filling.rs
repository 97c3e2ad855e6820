use std::sync::Arc;

use palpate_geometry::{FillSettings, TetrahedronMesh, fill, follow_sharp_edges, refine_to};

use super::problem::CondensedProblem;
use crate::regions::RegionError;
use crate::{Error, Law, LinearElastic};

/// Longest edges in a layer, in its thickness [-].
const IN_LAYER: f64 = 4.0;

/// Longest edges in a shape, in its smallest radius, and by how much they grow away from it [-].
const IN_SHAPE: f64 = 0.6;
const AT_SHAPES: f64 = 0.75;

/// The tetrahedra of a solid, which do not cross the borders of its regions.
pub(super) struct Filling {
    /// With the numbers of the regions.
    pub(super) mesh: TetrahedronMesh,
    /// The law of each region.
    pub(super) laws: Vec<Arc<dyn Law>>,
}

impl Filling {
    pub(super) fn of(problem: &CondensedProblem<'_>) -> Result<Self, Error> {
        let (surface, edge) = (problem.surface, problem.edge);
        let mesh = follow_sharp_edges(fill(surface, &FillSettings::new(edge))?, surface)?;
        let Some(regions) = problem.regions else {
            let law = LinearElastic::new(1.0, problem.poissons_ratio)?;
            return Ok(Self {
                mesh,
                laws: vec![Arc::new(law)],
            });
        };
        let map = regions.map;
        let longest = mesh.quality().longest_edge * (1.0 + 1e-9);
        let mesh = refine_to(&mesh, Some(surface), |point| {
            let in_layer = IN_LAYER * map.thickness_at(point);
            let at_shapes = map.longest_edge_at_shapes(point, IN_SHAPE, AT_SHAPES);
            longest.min(in_layer).min(at_shapes)
        })?;
        let bounded: Vec<_> = map.bounded().collect();
        let found = map.bordered(&mesh, Some(surface), &[], &bounded)?;
        let numbers: Vec<u32> = (0..found.mesh.tetrahedra().len())
            .map(|tetrahedron| found.border_around(tetrahedron))
            .map(|border| border.map_or(0, |border| bounded[border] as u32))
            .collect();
        if let Some(region) = (1..regions.laws.len()).find(|n| !numbers.contains(&(*n as u32))) {
            return Err(RegionError::Nowhere { region: region - 1 }.into());
        }
        let laws = regions.laws.iter();
        Ok(Self {
            mesh: found.mesh.with_regions(numbers)?,
            laws: laws.map(|law| Arc::new(*law) as Arc<dyn Law>).collect(),
        })
    }
}
