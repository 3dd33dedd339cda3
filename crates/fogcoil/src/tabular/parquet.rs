//! A table as Apache Parquet: one row group, plain columns, no instant of writing in it.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::table::{Cells, Table};

pub(super) fn bytes(table: &Table) -> Result<Vec<u8>, ParquetError> {
    let fields = table.columns.iter().map(|column| field(&column.name, &column.cells).map(Arc::new));
    let schema = Type::group_type_builder("table").with_fields(fields.collect::<Result<_, _>>()?).build()?;
    let about = table.about.iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone())).collect();
    let program = format!("fogcoil {}", env!("CARGO_PKG_VERSION"));
    let properties = WriterProperties::builder().set_created_by(program).set_key_value_metadata(Some(about)).build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for column in &table.columns {
        write(&mut group, &column.cells)?;
    }
    group.close()?;
    writer.into_inner()
}

fn field(name: &str, cells: &Cells) -> Result<Type, ParquetError> {
    let of = |physical, repetition| Type::primitive_type_builder(name, physical).with_repetition(repetition);
    match cells {
        Cells::Whole(_) => of(Physical::INT64, Repetition::REQUIRED).build(),
        Cells::Numbers(_) => of(Physical::DOUBLE, Repetition::OPTIONAL).build(),
        Cells::Texts(_) => of(Physical::BYTE_ARRAY, Repetition::OPTIONAL).with_logical_type(Some(LogicalType::String)).build(),
    }
}

fn write(group: &mut SerializedRowGroupWriter<'_, Vec<u8>>, cells: &Cells) -> Result<(), ParquetError> {
    match cells {
        Cells::Whole(cells) => column::<Int64Type>(group, cells, None),
        Cells::Numbers(cells) => {
            let there: Vec<f64> = cells.iter().copied().flatten().collect();
            column::<DoubleType>(group, &there, Some(levels(cells)))
        }
        Cells::Texts(cells) => {
            let there: Vec<ByteArray> = cells.iter().flatten().map(|text| ByteArray::from(text.as_str())).collect();
            column::<ByteArrayType>(group, &there, Some(levels(cells)))
        }
    }
}

/// 1 where there is a value, 0 where there is none.
fn levels<T>(cells: &[Option<T>]) -> Vec<i16> {
    cells.iter().map(|cell| i16::from(cell.is_some())).collect()
}

fn column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: &[T::T],
    levels: Option<Vec<i16>>,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else { return Ok(()) };
    column.typed::<T>().write_batch(values, levels.as_deref(), None)?;
    column.close()
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    use super::*;

    /// The same library reads it back; that others do is shown in the how-to.
    #[test]
    fn every_cell_reads_back() {
        let table = super::super::table::hard();
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes(&table).unwrap()).unwrap();
        let reader = SerializedFileReader::new(file.reopen().unwrap()).unwrap();
        let about = reader.metadata().file_metadata().key_value_metadata().unwrap();
        assert!(about.iter().any(|entry| entry.key == "made by" && entry.value.as_deref() == Some("a test")));
        let rows: Vec<Vec<Field>> = reader
            .get_row_iter(None)
            .unwrap()
            .map(|row| row.unwrap().get_column_iter().map(|(_, field)| field.clone()).collect())
            .collect();
        assert_eq!(rows[0], [Field::Long(1), Field::Double(0.1), Field::Str("a \"b\", c".into())]);
        assert_eq!(rows[1], [Field::Long(2), Field::Null, Field::Str("=1+1".into())]);
        assert_eq!(rows[2], [Field::Long(3), Field::Double(-1.0 / 3.0), Field::Null]);
    }
}
