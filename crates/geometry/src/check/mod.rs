pub(crate) mod topology;
